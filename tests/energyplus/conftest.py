"""Whole runs of EnergyPlus. They need build/EnergyPlus (scripts/build) and skip, saying so, without it."""

import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(REPOSITORY / "scripts"), str(Path(__file__).resolve().parent)]

import pytest  # noqa: E402
from shading_runs import energyplus  # noqa: E402

WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"


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
    return energyplus.find_weather(WEATHER)


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
