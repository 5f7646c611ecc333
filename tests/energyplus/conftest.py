"""Whole runs of EnergyPlus. They need build/EnergyPlus (scripts/build) and skip, saying so, without it."""

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
