"""Examples that the wheel copies out."""

import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "idf_examples"
MODULE = ROOT / "scripts" / "wheel" / "energyplus_gpu_shading" / "examples.py"
spec = importlib.util.spec_from_file_location("examples", MODULE)
examples = importlib.util.module_from_spec(spec)
spec.loader.exec_module(examples)


@pytest.fixture
def energyplus(tmp_path):
    folder = tmp_path / "EnergyPlus"
    (folder / "WeatherData").mkdir(parents=True)
    (folder / "WeatherData" / "USA_CO_Golden-NREL.724666_TMY3.epw").write_text("LOCATION,Golden\n")
    return folder


@pytest.mark.parametrize("name", ["box_with_louvres", "courtyard", "south_office"])
def test_an_example_comes_with_its_weather(name, energyplus, tmp_path):
    folder = examples.copy(name, EXAMPLES, energyplus, tmp_path / "mine")
    model = f"{name}.idf"
    assert (folder / model).read_bytes() == (EXAMPLES / name / model).read_bytes()
    assert (folder / "weather.epw").read_text() == "LOCATION,Golden\n"


@pytest.mark.parametrize("name", ["", "canopy", "../tests"])
def test_what_is_not_an_example_is_refused_with_those_that_are(name, energyplus, tmp_path):
    with pytest.raises(SystemExit, match="expected one of box_with_louvres, courtyard, south_office"):
        examples.copy(name, EXAMPLES, energyplus, tmp_path / "mine")


def test_a_folder_that_exists_is_kept(energyplus, tmp_path):
    (tmp_path / "mine").mkdir()
    with pytest.raises(SystemExit, match="exists already"):
        examples.copy("courtyard", EXAMPLES, energyplus, tmp_path / "mine")
    assert not any((tmp_path / "mine").iterdir())


def test_the_models_are_for_this_weather():
    for model in EXAMPLES.glob("*/*.idf"):
        page = model.with_name("README.md").read_text(encoding="utf-8") + model.read_text(encoding="utf-8")
        assert examples.WEATHER in page, model
