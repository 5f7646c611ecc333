"""Whole runs of EnergyPlus. They need build/EnergyPlus (scripts/build) and skip, saying so, without it."""

import os
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(REPOSITORY / "scripts"), str(Path(__file__).resolve().parent)]

import pytest  # noqa: E402
import windows  # noqa: E402
from shading_runs import energyplus  # noqa: E402


@pytest.fixture(scope="session")
def official():
    """The program as it was released."""
    program = energyplus.official_prefix() / "energyplus"
    if not program.is_file():
        pytest.skip(f"{program} is missing: run scripts/setup")
    return program


@pytest.fixture(scope="session")
def patched():
    """The program that the build makes of it."""
    program = energyplus.patched_prefix() / "energyplus"
    if not program.is_file():
        pytest.skip(f"{program} is missing: run scripts/build")
    return program


@pytest.fixture(scope="session")
def weather():
    return energyplus.find_weather(windows.WEATHER)


@pytest.fixture
def run(patched, weather, tmp_path):
    """Runs the design days of a model, given as text, with the flag; `name`: of its file and its folder."""

    def call(text, name, *options):
        path = tmp_path / f"{name}.idf"
        path.write_text(text)
        done = energyplus.run(patched, path, weather, tmp_path / name, ["-D", "--gpu-shading", *options])
        assert done.completed, done.why()
        return done

    return call


@pytest.fixture(scope="session")
def courtyard():
    return REPOSITORY / "idf_examples" / "courtyard" / "courtyard.idf"


@pytest.fixture(scope="session")
def louvres():
    """Writes the model of a box with a number of louvres."""
    sys.path.insert(0, str(REPOSITORY / "idf_examples" / "box_with_louvres"))
    import generate

    return generate.model


@pytest.fixture(scope="session")
def box(louvres):
    """A model that is quick to run: one louvre."""
    return louvres(1)


@pytest.fixture(scope="session")
def sampled_box(louvres):
    """The same with a shade that is not flat, behind which there are samples at any resolution."""
    return louvres(1) + """
Shading:Building:Detailed,
  Sail,,4,
  1.5,-0.5,2.8,
  1.5,-0.9,2.7,
  4.5,-0.9,2.4,
  4.5,-0.5,2.8;
"""


@pytest.fixture(scope="session")
def wine(tmp_path_factory):
    """A Windows to run programs in."""
    if why := windows.why_not():
        pytest.skip(why)
    made = windows.Wine(tmp_path_factory.mktemp("wine"))
    yield made
    made.close()


@pytest.fixture(scope="session")
def windows_official(wine, tmp_path_factory):
    """EnergyPlus for Windows, as it was released."""
    if not (windows.official_folder() / "energyplus.exe").is_file():
        pytest.skip("EnergyPlus for Windows is missing: run scripts/setup --windows")
    return windows.copy_energyplus(tmp_path_factory.mktemp("stock") / "EnergyPlus")


@pytest.fixture(scope="session")
def windows_patched(wine, windows_official, tmp_path_factory):
    """The program of a folder that patch_energyplus.cmd made of it."""
    return windows.patch_energyplus(wine, windows_official.parent, tmp_path_factory.mktemp("patched") / "Energy Plüs")


@pytest.fixture
def small_disk(tmp_path):
    """Mounts a file system of so many kB, with a file that leaves only some of it."""
    mounted = []

    def mount(size, free):
        folder = tmp_path / f"disk{len(mounted)}"
        folder.mkdir()
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", folder],
                              capture_output=True, text=True)
        if done.returncode != 0:
            pytest.skip(f"no small file system can be mounted: {done.stderr.strip()}")
        mounted.append(folder)
        return folder, lambda: fill(folder, free)

    def fill(folder, free):
        status = os.statvfs(folder)
        (folder / "full").write_bytes(b"\0" * (status.f_bavail * status.f_frsize - 1024 * free))

    yield mount
    for folder in mounted:
        subprocess.run(["umount", folder], check=True)
