"""The libenergyplusapi.so of a patched folder: every host of it is shaded with GPU_SHADING, and stock without."""

import functools
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import screened_room
from shading_runs import energyplus, results

HOSTS = Path(__file__).resolve().parent / "hosts"
SCRIPT = energyplus.REPOSITORY / "scripts" / "patch_energyplus"
FORWARDED = energyplus.REPOSITORY / "energyplus_patch" / "routes" / "patched" / "c_api" / "function_names.inc"
PYTHON_API = energyplus.REPOSITORY / ".venv" / "EnergyPlus-lbnl" / "pyenergyplus"
OURS = {"energyplus", "_Z13EnergyPlusPgmRKSt6vectorINSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEESaIS5_EERKS5_"}


@pytest.fixture
def room(tmp_path):
    """A room whose screen polygon clipping cannot have."""
    model = tmp_path / "room.idf"
    model.write_text(screened_room.model(screen="small holes"))
    return model


@pytest.fixture(scope="module")
def with_python(official, tmp_path_factory):
    """(a folder of the official EnergyPlus with its Python package, what patch_energyplus makes of it)"""
    if not PYTHON_API.is_dir():
        pytest.skip(f"{PYTHON_API} is missing: scripts/setup could not fetch pyenergyplus-lbnl")
    folder = tmp_path_factory.mktemp("python")
    stock, dest = folder / "EnergyPlus", folder / "EnergyPlus-gpu"
    stock.mkdir()
    for path in official.parent.iterdir():
        if path.name.startswith("libenergyplusapi"):
            # The package finds the library beside its own real folder.
            os.link(path.resolve(), stock / path.name)
        else:
            (stock / path.name).symlink_to(path)
    subprocess.run(["cp", "-r", PYTHON_API, stock], check=True)
    done = subprocess.run([SCRIPT, stock, dest, "--build", energyplus.patched_prefix().parent],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return stock, dest


def finish(command, folder, environment):
    """Runs a host whose results go into the folder, which it gets."""
    folder.mkdir()
    variables = {key: value for key, value in os.environ.items()
                 if key != "DISPLAY" and not key.startswith("GPU_SHADING")}
    done = subprocess.run([str(word) for word in command], cwd=folder, env=variables | environment,
                          capture_output=True, text=True)
    return energyplus.Run(done.returncode, done.stdout, done.stderr, folder, 0.0)


def python_host(prefix, model, weather, folder, environment):
    return finish([sys.executable, HOSTS / "plain_host.py", prefix, "-D", "-w", weather, "-d", folder, model], folder,
                  environment)


def link(program, folder, *options):
    """Builds a host with the library of a folder; which one it runs is the loader's choice."""
    subprocess.run(["cc", "-Wall", "-Wextra", "-Werror", "-o", program, HOSTS / "linked_host.c", "-L", folder,
                    "-lenergyplusapi", *options], check=True)


def linked(program, prefix, model, weather, folder, environment, second=()):
    variables = {"LD_LIBRARY_PATH": str(prefix)}
    return finish([program, folder, model, weather, *second], folder, variables | environment)


@pytest.fixture(scope="session")
def linked_host(patched, tmp_path_factory):
    """Linked with the patched folder."""
    program = tmp_path_factory.mktemp("hosts") / "linked_host"
    link(program, patched.parent)
    return functools.partial(linked, program)


def timesteps(run):
    """What the room's window transmits, and the sun's position, at each timestep."""
    assert run.completed, run.why()
    values = screened_room.timesteps(run)
    assert sum(values["all"]) > 0 and sum(values["beam"]) > 0
    return values


def without_times(text):
    return re.sub(r"\d{4}\.\d\d\.\d\d \d\d:\d\d|Elapsed Time=.*|\d\d:\d\d:\d\d", "", text)


def assert_same_outputs(one, other):
    names = sorted(path.name for path in one.folder.iterdir())
    assert names == sorted(path.name for path in other.folder.iterdir()) and "eplusout.eso" in names
    # Those hold times and the folder in other forms.
    for name in set(names) - {"eplusout.sql", "eplustbl.htm", "sqlite.err"}:
        assert without_times(one.text(name)) == without_times(other.text(name)), name
    assert results.Results(one.folder).values == results.Results(other.folder).values


def exported(library):
    listed = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True).stdout
    return {line.split()[-1].split("@")[0] for line in listed.splitlines()}


def test_every_symbol_of_the_official_library_is_there(patched, official):
    library = patched.parent / "libenergyplusapi.so"
    names = exported(official.parent / "libenergyplusapi.so")
    assert len(names) > 1000
    # In a process of its own, since EnergyPlus brings old copies of libraries.
    script = """
import ctypes, sys
ours, official = (ctypes.CDLL(path) for path in sys.argv[1:])
for name in sys.stdin.read().split():
    here, there = (ctypes.cast(getattr(library, name), ctypes.c_void_p).value for library in (ours, official))
    print(name, here == there)
"""
    told = subprocess.run([sys.executable, "-c", script, library, patched.parent / "libenergyplusapi-official.so"],
                          input="\n".join(names), capture_output=True, text=True, check=True).stdout
    other = {name for name, same in (line.split() for line in told.splitlines()) if same == "False"}
    # By a jump to the official ones.
    forwarded = set(re.findall(r"^API_FUNCTION\((\w+)\)", FORWARDED.read_text(), re.M))
    assert len(forwarded) > 150
    assert other == OURS | forwarded
    assert exported(library) >= OURS | forwarded


def test_functions_of_the_c_api_are_those_of_its_headers(official):
    headers = (official.parent / "include" / "EnergyPlus" / "api").glob("*.h")
    text = re.sub(r"//.*", "", "".join(path.read_text() for path in headers))
    declared = set(re.findall(r"ENERGYPLUSLIB_API\s+[^;(]*?(\w+)\s*\(", text)) - {"__attribute__", "__declspec"}
    forwarded = set(re.findall(r"^API_FUNCTION\((\w+)\)", FORWARDED.read_text(), re.M))
    assert forwarded == declared - {"energyplus"}


def test_python_api_is_shaded_by_the_variable_alone(with_python, patched, weather, room, tmp_path):
    stock, prefix = with_python
    direct = energyplus.run(patched, room, weather, tmp_path / "direct", ["--gpu-shading", "-D"])
    hosted = python_host(prefix, room, weather, tmp_path / "hosted", {"GPU_SHADING": "1"})
    assert hosted.method == "PixelCounting" and hosted.rendering
    assert timesteps(hosted) == timesteps(direct)
    # Which the official library cannot run.
    assert not python_host(stock, room, weather, tmp_path / "stock", {"GPU_SHADING": "1"}).completed


def test_python_api_without_the_variable_is_stock(with_python, weather, box, tmp_path):
    stock, prefix = with_python
    model = tmp_path / "model.idf"
    model.write_text(box + "Output:SQLite,Simple;\n"
                     "Output:Variable,*,Surface Outside Face Sunlit Fraction,Hourly;\n")
    runs = [python_host(folder, model, weather, tmp_path / name, {})
            for folder, name in ((stock, "official"), (prefix, "ours"))]
    assert all(run.completed for run in runs), runs[1].why()
    assert runs[1].method == "PolygonClipping"
    assert_same_outputs(*runs)


def test_linked_program_is_shaded_by_the_variable_alone(linked_host, patched, weather, room, tmp_path):
    direct = energyplus.run(patched, room, weather, tmp_path / "direct", ["--gpu-shading", "-D"])
    hosted = linked_host(patched.parent, room, weather, tmp_path / "hosted", {"GPU_SHADING": "on"})
    assert timesteps(hosted) == timesteps(direct)


def test_program_that_was_linked_with_the_official_library_is_shaded(official, patched, weather, room, tmp_path):
    link(tmp_path / "host", official.parent, "-Wl,--allow-shlib-undefined")
    direct = energyplus.run(patched, room, weather, tmp_path / "direct", ["--gpu-shading", "-D"])
    hosted = linked(tmp_path / "host", patched.parent, room, weather, tmp_path / "hosted", {"GPU_SHADING": "on"})
    assert timesteps(hosted) == timesteps(direct)


def test_options_come_from_the_environment_of_each_run(linked_host, patched, weather, room, tmp_path):
    """And extension objects from the file beside the model."""
    (tmp_path / "room.gpu-shading.idf").write_text("GPUShading:Settings,32;\n")
    (tmp_path / "second").mkdir()
    run = linked_host(patched.parent, room, weather, tmp_path / "first", {"GPU_SHADING": "auto"},
                      ["GPU_SHADING_RESOLUTION=128", tmp_path / "second", room, weather])
    assert run.fineness.startswith("32"), run.our_lines
    assert "128" in energyplus.Run(0, "", "", tmp_path / "second", 0.0).fineness


def test_an_explicit_call_stands(patched, weather, room, tmp_path):
    run = finish([sys.executable, HOSTS / "host.py", patched.parent, "--gpu-shading-resolution=32", "1", "-D", "-w",
                  weather, "-d", tmp_path / "out", room], tmp_path / "out",
                 {"GPU_SHADING": "1", "GPU_SHADING_ERROR": "0.01"})
    assert run.completed, run.why()
    assert run.fineness.startswith("32"), run.our_lines


@pytest.mark.parametrize("value", ["bogus", "require"])
def test_a_bad_choice_ends_the_run_in_one_line(value, linked_host, patched, weather, room, tmp_path):
    environment = {"GPU_SHADING": value, "GPU_SHADING_DEVICE": "99" if value == "require" else ""}
    run = linked_host(patched.parent, room, weather, tmp_path / "out", environment)
    assert run.status == 1 and not run.completed
    ours = [line for line in run.errors.splitlines() if line.startswith("gpu_shading: error: ")]
    assert len(ours) == 1 and (value if value == "bogus" else "99") in ours[0]


def test_unsetting_the_variable_between_runs_is_refused(linked_host, patched, weather, room, tmp_path):
    """EnergyPlus stays patched, so that a second run would be shaded without being asked to."""
    (tmp_path / "second").mkdir()
    run = linked_host(patched.parent, room, weather, tmp_path / "first", {"GPU_SHADING": "1"},
                      ["GPU_SHADING=", tmp_path / "second", room, weather])
    assert run.status == 3
    assert "set it to off" in run.errors
    assert "set it to off" in (tmp_path / "second" / "eplusout.err").read_text()
    assert not (tmp_path / "second" / "eplusout.eio").exists()


def test_a_library_that_cannot_be_patched_says_so(linked_host, weather, box, tmp_path):
    if not PYTHON_API.is_dir():
        pytest.skip(f"{PYTHON_API} is missing: scripts/setup could not fetch pyenergyplus-lbnl")
    dest = tmp_path / "EnergyPlus"
    subprocess.run([SCRIPT, PYTHON_API.parent, dest, "--build", energyplus.patched_prefix().parent], check=True,
                   capture_output=True)
    model = tmp_path / "model.idf"
    model.write_text(box)
    run = python_host(dest, model, weather, tmp_path / "shaded", {"GPU_SHADING": "1"})
    assert run.status == 1 and "passes sunlit fractions as schedules" in run.errors
    assert python_host(dest, model, weather, tmp_path / "stock", {}).completed


def test_a_moved_installation_is_said(with_python, weather, box, tmp_path):
    stock, _ = with_python
    moved, dest, model = tmp_path / "moved", tmp_path / "EnergyPlus", tmp_path / "model.idf"
    subprocess.run(["cp", "-r", stock, moved], check=True)
    subprocess.run([SCRIPT, moved, dest, "--build", energyplus.patched_prefix().parent], check=True,
                   capture_output=True)
    moved.rename(tmp_path / "elsewhere")
    model.write_text(box)
    for options in ([], ["--gpu-shading"]):
        run = energyplus.run(dest / "energyplus", model, weather, tmp_path / f"out{len(options)}", options)
        assert run.status == 1
        assert run.errors.count("\n") == 1 and "create this folder again with patch_energyplus" in run.errors
    check = subprocess.run([dest / "gpu_shading", "check", model], capture_output=True, text=True)
    assert check.returncode == 1 and "create this folder again with patch_energyplus" in check.stderr


def test_host_that_is_refused_finds_the_reason_in_the_files(linked_host, patched, room, weather, tmp_path):
    done = linked_host(patched.parent, room, weather, tmp_path / "out",
                       {"GPU_SHADING": "1", "GPU_SHADING_ERROR": "many"})
    assert done.status != 0 and "GPU_SHADING_ERROR" in done.errors
    err = (tmp_path / "out" / "eplusout.err").read_text()
    assert "   ** Severe  ** gpu_shading: GPU_SHADING_ERROR" in err
    assert "EnergyPlus Terminated--Fatal Error Detected." in (tmp_path / "out" / "eplusout.end").read_text()
