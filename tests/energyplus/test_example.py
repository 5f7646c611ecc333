"""`gpu_shading example` copies a model that the manual's commands can be tried on."""

import os
import re
import subprocess

import pytest
from shading_runs.energyplus import REPOSITORY

EXAMPLES = REPOSITORY / "idf_examples"
SOURCE = REPOSITORY / "energyplus_patch" / "programs" / "gpu_shading" / "example.cpp"


@pytest.fixture
def example(patched, tmp_path):
    def run(*arguments, program="gpu_shading", **variables):
        return subprocess.run([patched.parent / program, "example", *arguments], cwd=tmp_path, capture_output=True,
                              text=True, env=os.environ | variables)

    return run


@pytest.mark.parametrize("program", ["gpu_shading", "energyplus", "energyplus-gpu"])
@pytest.mark.parametrize("name", ["box_with_louvres", "courtyard", "south_office", "trees"])
def test_an_example_comes_with_its_weather(name, program, example, weather, tmp_path):
    done = example(name, program=program)
    assert done.returncode == 0, done.stderr
    copied = sorted(path.name for path in (tmp_path / name).iterdir())
    assert done.stdout.splitlines() == [f"{name}/{file}" for file in copied] and "weather.epw" in copied
    model = f"{name}.idf"
    assert (tmp_path / name / model).read_bytes() == (EXAMPLES / name / model).read_bytes()
    assert (tmp_path / name / "weather.epw").read_bytes() == weather.read_bytes()


@pytest.mark.parametrize("name, hint", [("canopy", ""), ("../tests", ""), ("courtyrd", "; did you mean courtyard?")])
def test_what_is_not_an_example_is_refused_with_those_that_are(name, hint, example, tmp_path):
    assert example(name).stderr == (f"gpu_shading: error: example {name}: expected one of box_with_louvres, courtyard, "
                                    f"pv_roof, south_office, trees{hint}\n")
    assert not any(tmp_path.iterdir())


def test_a_folder_that_exists_is_kept(example, tmp_path):
    (tmp_path / "courtyard").mkdir()
    assert example("courtyard").stderr.endswith("example courtyard: courtyard: exists already: move it away\n")
    assert not any((tmp_path / "courtyard").iterdir())


def test_the_models_are_for_this_weather():
    weather = re.search(r'weather_file = "(.*)"', SOURCE.read_text())[1]
    for model in EXAMPLES.glob("*/*.idf"):
        page = model.with_name("README.md").read_text(encoding="utf-8") + model.read_text(encoding="utf-8")
        assert weather in page, model
