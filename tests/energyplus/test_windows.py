"""EnergyPlus for Windows with our files beside it, under Wine: against polygon clipping in the same Windows, and
against the patched EnergyPlus of Linux."""

import shutil
import subprocess
import sys

import pytest
import windows
from output_files import differing, snapshot
from shading_runs import energyplus, input_file, results

HOSTS = energyplus.REPOSITORY / "tests" / "energyplus" / "hosts"
LIBRARY = windows.build_folder() / "energyplus_patch" / "opengl32.dll"

# As test_models.py has them.
MEAN = 3e-4
PERCENTILE_99 = 3e-3
# Both systems render with a target error of 1e-5; with the rounding of counts of 512 x 512 pixels.
ERROR = "0.00001"
SAME = 1e-4


@pytest.fixture(scope="module")
def wine(tmp_path_factory):
    if why := windows.why_not():
        pytest.skip(why)
    return windows.Wine(tmp_path_factory.mktemp("wine"))


@pytest.fixture(scope="module")
def stock(wine, tmp_path_factory):
    """EnergyPlus for Windows, as it was released."""
    if not (windows.official_folder() / "energyplus.exe").is_file():
        pytest.skip("EnergyPlus for Windows is missing: run scripts/setup --windows")
    return windows.copy_energyplus(tmp_path_factory.mktemp("stock") / "EnergyPlus")


@pytest.fixture(scope="module")
def dropped_in(stock, tmp_path_factory):
    """The same with the library beside it."""
    return windows.copy_energyplus(tmp_path_factory.mktemp("our s ü") / "EnergyPlus", LIBRARY)


@pytest.fixture(scope="module")
def rendering(wine, stock, tmp_path_factory):
    """The program of a patched folder."""
    return windows.patch_energyplus(wine, tmp_path_factory.mktemp("patched") / "Energy Plus")


@pytest.mark.parametrize("program", ["unit_tests", "optics/optics_tests", "site/site_tests", "solar/solar_tests"])
def test_the_library_passes_its_own_tests(wine, program):
    done = wine.run([windows.build_folder() / "tests" / "unit" / f"{program}.exe"])
    assert done.returncode == 0, done.stdout[-4000:]
    assert "[  PASSED  ]" in done.stdout


def louvres_model(louvres, count, folder):
    path = folder / f"louvres_{count}.idf"
    path.write_text(louvres(count))
    return path


def prepare(model, method, folder):
    own = input_file.read(model)
    results.instrument(own)
    own.set_field("ShadowCalculation", input_file.SHADOW_METHOD, method)
    return input_file.place_copy(own, model, folder)


def of_building(found):
    """Without shading surfaces, which are not rendered unless they are wanted."""
    return [each for each in found if each.receiver.zone]


@pytest.mark.parametrize("name", ["courtyard", "20 louvres", "box", "4ZoneWithShading_Simple_2"])
def test_sunlit_fractions(wine, stock, dropped_in, patched, weather, louvres, courtyard, tmp_path, name):
    if name == "courtyard":
        model = courtyard
    elif name in ("20 louvres", "box"):
        model = louvres_model(louvres, 20 if name == "20 louvres" else 1, tmp_path)
    else:
        model = energyplus.models_folder() / f"{name}.idf"
        if not model.is_file():
            pytest.skip(f"{model} is missing")
    counted = prepare(model, "PixelCounting", tmp_path / "counted")
    clipped = prepare(model, "PolygonClipping", tmp_path / "clipped")
    options = ["-D"]
    ours = wine.run_energyplus(dropped_in, counted, weather, tmp_path / "ours", options, GPU_SHADING_ERROR=ERROR)
    assert ours.completed, ours.why()
    assert ours.method == "PixelCounting"  # EnergyPlus falls back to polygon clipping without OpenGL
    clipping = wine.run_energyplus(stock, clipped, weather, tmp_path / "clipping", options)
    assert clipping.method == "PolygonClipping"
    linux = energyplus.run(patched, clipped, weather, tmp_path / "linux",
                           [*options, "--gpu-shading", f"--gpu-shading-error={ERROR}", "--gpu-shading-device=cpu"])
    assert clipping.completed and linux.completed
    answers = results.Results(ours.folder)
    same = of_building(results.differences(results.Results(linux.folder), answers))
    assert same
    for each in same:
        assert each.largest < SAME, f"{each.receiver.name}: {each.largest} from the answer on Linux"
    if name == "20 louvres":  # polygon clipping is wrong: docs/accuracy.md
        return
    for each in of_building(results.differences(results.Results(clipping.folder), answers)):
        worst = results.percentile([abs(value) for value in each.values], 0.99)
        assert each.mean < MEAN and worst < PERCENTILE_99, f"{each.receiver.name}: {each.mean}, {worst}"


def test_a_thousand_louvres(wine, dropped_in, patched, weather, louvres, tmp_path):
    """Polygon clipping needs minutes for these, and is wrong."""
    model = louvres_model(louvres, 1000, tmp_path)
    ours = wine.run_energyplus(dropped_in, prepare(model, "PixelCounting", tmp_path / "counted"), weather,
                               tmp_path / "ours", ["-D"])
    linux = energyplus.run(patched, prepare(model, "PolygonClipping", tmp_path / "clipped"), weather,
                           tmp_path / "linux", ["-D", "--gpu-shading", "--gpu-shading-device=cpu"])
    assert ours.completed and linux.completed and ours.method == "PixelCounting"
    window = [each for each in results.differences(results.Results(linux.folder), results.Results(ours.folder))
              if each.receiver.kind == "Window"]
    assert len(window) == 1 and window[0].largest < SAME


def canopy():
    """A model with an extension object: 500 panes of glass."""
    folder = energyplus.REPOSITORY / "idf_examples" / "canopy"
    return subprocess.run([sys.executable, folder / "generate.py"], capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("name", ["courtyard", "canopy", "1000 louvres", "4ZoneWithShading_Simple_2"])
def test_rendering_is_that_of_linux(wine, rendering, patched, weather, louvres, courtyard, tmp_path, name):
    """With the same target error, the default, and the same command line."""
    folder = tmp_path / "ö ß"
    folder.mkdir()
    model = folder / f"{name}.idf"
    if name == "canopy":
        model.write_text(canopy())
    elif name == "1000 louvres":
        model.write_text(louvres(1000))
    elif name == "courtyard":
        model.write_text(courtyard.read_text())
    else:
        other = energyplus.models_folder() / f"{name}.idf"
        if not other.is_file():
            pytest.skip(f"{other} is missing")
        model.write_text(other.read_text(encoding="utf-8", errors="replace"))
    own = input_file.read(model)
    results.instrument(own)
    model = input_file.place_copy(own, model, folder / "input")
    ours = wine.run_energyplus(rendering, model, weather, folder / "ours", ["-D", "--gpu-shading"])
    assert ours.completed, ours.why()
    assert "rendered by CPU" in ours.errors
    linux = energyplus.run(patched, model, weather, tmp_path / "linux",
                           ["-D", "--gpu-shading", "--gpu-shading-device=cpu"])
    assert linux.completed
    found = results.differences(results.Results(linux.folder), results.Results(ours.folder))
    assert found
    for each in found:
        assert each.largest < SAME, f"{each.receiver.name}: {each.largest} from the answer on Linux"


def test_without_the_flag_it_is_the_official_program(wine, stock, rendering, weather, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box)
    folder = tmp_path / "out"
    outputs = []
    for program in (stock, rendering):
        shutil.rmtree(folder, ignore_errors=True)
        done = wine.run_energyplus(program, model, weather, folder, ["-D"])
        assert done.status == 0
        outputs.append(snapshot(folder))
    assert differing(*outputs) == []
    failed = wine.run([rendering, "--no-such-option"])
    assert failed.returncode == wine.run([stock, "--no-such-option"]).returncode != 0


def test_schedules_at_the_time_of_a_question(wine, rendering, patched, weather, louvres, tmp_path):
    """Louvres that a schedule opens by the clock, other on design days than on others."""
    path = tmp_path / "louvres.idf"
    text = louvres(3)
    for number in (1, 2, 3):
        text = text.replace(f"Louvre {number},,4", f"Louvre {number},Opening,4")
    assert text.count("Opening") == 3
    path.write_text(text + "Schedule:Compact,Opening,,Through: 12/31,For: SummerDesignDay,Until: 11:30,0.1,"
                    "Until: 24:00,0.6,For: AllOtherDays,Until: 10:00,0.2,Until: 14:15,0.7,Until: 24:00,0;\n")
    own = input_file.read(path)
    own.add_unique("RunPeriod", ["Days", 5, 30, 2017, 6, 1],
                   ["name", "begin_month", "begin_day_of_month", "begin_year", "end_month", "end_day_of_month"])
    own.set_field("SimulationControl", (3, "run_simulation_for_sizing_periods"), "Yes")
    results.instrument(own, "Timestep")
    model = input_file.place_copy(own, path, tmp_path / "input")
    ours = wine.run_energyplus(rendering, model, weather, tmp_path / "ours", ["--gpu-shading"])
    assert ours.completed, ours.why()
    linux = energyplus.run(patched, model, weather, tmp_path / "linux", ["--gpu-shading", "--gpu-shading-device=cpu"])
    assert linux.completed
    found = results.differences(*(results.Results(run.folder, "Zone Timestep") for run in (linux, ours)))
    assert any(0.05 < value < 0.95 for each in found for value in each.reference)
    for each in found:
        assert each.largest < SAME, f"{each.receiver.name}: {each.largest} from the answer on Linux"


def test_the_program_lists_surfaces_as_on_linux(wine, rendering, patched, courtyard):
    tables = []
    for done in (wine.run([rendering.parent / "gpu_shading.exe", "check", windows.name_path(courtyard)]),
                 subprocess.run([patched.parent / "gpu_shading", "check", courtyard], capture_output=True, text=True)):
        assert done.returncode == 0, done.stderr
        # Reveals are numbered from the drawing.
        tables.append([line.rstrip() for line in done.stdout.splitlines() if " reveal " not in line])
    assert len(tables[0]) > 20 and tables[0] == tables[1]


def test_an_error_in_an_extension_object_stops_before_the_run(wine, rendering, weather, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box + "GPUShading:TransparentShade,Glass,Louvre 1,Constant,,,2;\n")
    done = wine.run_energyplus(rendering, model, weather, tmp_path / "out", ["-D", "--gpu-shading"])
    assert done.status == 1 and not (done.folder / "eplusout.err").exists()
    assert "model.idf: GPUShading:TransparentShade Glass: Value 1 is blank" in done.errors


def test_an_error_ends_the_run(wine, dropped_in, weather, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box.replace("PolygonClipping,", "PixelCounting,"))
    ours = wine.run_energyplus(dropped_in, model, weather, tmp_path / "ours", ["-D"], GPU_SHADING_ERROR="two")
    assert ours.status == 1 and not ours.completed
    assert "gpu_shading: error: GPU_SHADING_ERROR is 'two': expected a number, 1e-5 to 0.1" in ours.errors


def test_other_programs_get_the_systems_opengl(wine, tmp_path):
    compiler = shutil.which("x86_64-w64-mingw32-gcc-posix")
    if not compiler:
        pytest.skip("MinGW is missing: run scripts/setup --windows")
    program = tmp_path / "vendor.exe"
    subprocess.run([compiler, "-o", program, HOSTS / "opengl_vendor.c", "-lopengl32", "-lgdi32"], check=True)
    without = wine.run([program])
    if without.returncode != 0:
        pytest.skip("this Wine has no OpenGL")
    shutil.copy(LIBRARY, tmp_path)
    beside = wine.run([program], WINEDEBUG="+loaddll")
    assert beside.stdout == without.stdout != ""
    assert f"{tmp_path.name}\\\\OPENGL32.dll".lower() in beside.stderr.lower()
