"""The wheel, in a virtual environment of its own, computes what the build does."""

import os
import subprocess
import sys

import pytest
from shading_runs import energyplus

WHEELS = energyplus.REPOSITORY / "out" / "wheel"


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """The bin folder of an environment with the wheel alone."""
    wheels = sorted(WHEELS.glob("energyplus_gpu_shading-*.whl"))
    if not wheels:
        pytest.skip(f"{WHEELS} has no wheel: run scripts/build_wheel")
    folder = tmp_path_factory.mktemp("wheel") / "venv"
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    pip = [folder / "bin" / "pip", "install", "--quiet", "--disable-pip-version-check"]
    subprocess.run([*pip, f"{wheels[-1]}[compare]"], check=True)
    return folder / "bin"


def installed_only():
    """Variables without what belongs to the repository."""
    return {key: value for key, value in os.environ.items() if not key.startswith(("GPU_SHADING", "PYTHON"))}


def test_its_answers_are_those_of_the_build(environment, patched, louvres, weather, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(louvres(20) + "Output:Variable,*,Surface Outside Face Sunlit Fraction,Hourly;\n")
    reference = energyplus.run(patched, model, weather, tmp_path / "build", ["--gpu-shading", "-D"])
    wheel = energyplus.run(environment / "energyplus-gpu", model, weather, tmp_path / "wheel", ["--gpu-shading", "-D"])
    assert reference.completed and wheel.completed, wheel.why()
    assert wheel.method == "PixelCounting"
    answers = [(run.folder / "eplusout.eso").read_text().partition("End of Data Dictionary")[2]
               for run in (reference, wheel)]
    assert answers[0] and answers[0] == answers[1]


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


def test_no_library_of_the_build_is_needed(environment):
    """Every library of ours finds what it needs beside it, or in what every Linux has."""
    package = next((environment.parent / "lib").glob("python3*/site-packages/energyplus_gpu_shading"))
    for path in (package / "libexec" / "gpu_shading").iterdir():
        listed = subprocess.run(["ldd", path], capture_output=True, text=True).stdout
        for line in listed.splitlines():
            # EnergyPlus's own, by the name that it has in a patched folder.
            assert "not found" not in line or "libenergyplusapi-official.so" in line, path.name
            name, _, place = line.strip().partition(" => ")
            if name.startswith(("libtbb", "libfmt", "libZydis", "libelf", "libGeographicLib", "libxxhash")):
                assert place.startswith(str(package)), line


def test_compare_shading_finds_both_programs(environment, box, weather, tmp_path):
    (tmp_path / "model.idf").write_text(box)
    done = subprocess.run([environment / "compare_shading", "model.idf", "-w", weather, "-o", "compared", "--", "-D"],
                          cwd=tmp_path, capture_output=True, text=True, env=installed_only())
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "compared" / "receivers.csv").is_file()


def test_what_it_lacks_is_said(environment, box, weather, tmp_path):
    """Readers of images are not in the wheel."""
    (tmp_path / "model.idf").write_text(
        box + "GPUShading:PerforatedScreen,Image,*,Texture,tile.png,,,,,,0.001;\n")
    (tmp_path / "tile.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    run = energyplus.run(environment / "energyplus-gpu", tmp_path / "model.idf", weather, tmp_path / "out",
                         ["--gpu-shading", "-D"])
    assert not run.completed
    assert "PerforatedScreen IMAGE" in run.why().replace("Image", "IMAGE")
