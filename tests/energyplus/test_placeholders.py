"""Placeholders in EnergyPlus's input, and their mirrored copies, are in nothing that a command shows.

With an output of all surfaces, EnergyPlus asks for the sunlit fraction of every shading surface that it reads and of
its copy "Mir-...": placeholders stand in its input for surfaces that are hidden from it. The surfaces shown are
compared with those in the text of the model, and with what the same model shows without that output.
"""

import json
import re
import subprocess
import sys

import numpy as np
import pytest
import test_run_page
from output_files import rows_of
from PIL import Image
from shading_runs import energyplus

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
LOUVRES = 24  # more than are left out of EnergyPlus's input by default
LEAN = "--gpu-shading-lean=on"
OUTPUT = "Output:Variable,*,Surface Outside Face Sunlit Fraction,Hourly;\n"


def write(path, text):
    path.write_text(text)
    return path


@pytest.fixture(scope="module")
def models(louvres, tmp_path_factory):
    """The box behind hidden louvres: (with the output, without)."""
    folder = tmp_path_factory.mktemp("models")
    plain = louvres(LOUVRES)
    return write(folder / "shown.idf", plain + OUTPUT), write(folder / "plain.idf", plain)


@pytest.fixture
def program(patched, weather, tmp_path):
    def call(command, model, *arguments):
        done = subprocess.run([patched.parent / "gpu_shading", command, model, "-w", weather, LEAN, *arguments],
                              capture_output=True, text=True, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return call


def named(text, kinds):
    """Upper-case names of a model's objects."""
    return {name.strip().upper() for name in re.findall(rf"(?m)^\s*(?:{kinds}),\s*([^,]*),", text)}


def surfaces_of(model):
    """The names of its walls, windows and louvres."""
    text = model.read_text()
    found = [named(text, f"{kind}:Detailed") for kind in ("BuildingSurface", "FenestrationSurface", "Shading:Building")]
    assert len(found[2]) == LOUVRES
    return found


def building_of(model):
    """The names of what EnergyPlus shades: no floor on the ground."""
    walls, windows, _ = surfaces_of(model)
    exterior = {name for name in walls if name != "FLOOR"}
    assert len(exterior) == len(walls) - 1 and windows
    return exterior | windows


def test_check_lists_the_model(models, program):
    walls, windows, louvres = surfaces_of(models[0])
    listing = json.loads(program("check", models[0], "--json"))
    assert f"{LOUVRES} shading surfaces hidden" in " ".join(listing["remarks"])
    assert {row["name"] for row in listing["surfaces"] if row["kind"] != "reveal"} == walls | windows | louvres
    assert {row["name"] for row in listing["surfaces"] if row["receives"]} == building_of(models[0])
    assert "PLACEHOLDER" not in program("check", models[0])
    assert "PLACEHOLDER" not in program("check", models[0], "--vertices")
    tables = [[line for line in program("check", model).splitlines() if "hidden from EnergyPlus" not in line]
              for model in models]
    assert tables[0] == tables[1]


def test_maps_are_of_the_building(models, program, tmp_path):
    for name, chosen in (("all", []), ("pattern", ["--receivers", "*"])):
        folder = tmp_path / name
        program("map", models[0], "--from", "12-21", "--to", "12-21", "--spacing", "1", "-o", folder, *chosen)
        mapped = {row["receiver"] for row in rows_of(folder / "maps.csv")}
        # A pattern may choose any shading surface of the model too.
        assert building_of(models[0]) == {each for each in mapped if not each.startswith("LOUVRE")}
        assert name == "pattern" or mapped == building_of(models[0])


def test_samples_are_of_the_building(models, program, tmp_path):
    program("sample", models[0], "--mode", "coarse", "--gpu-shading-resolution=64", "-o", tmp_path / "samples")
    assert {row["receiver"] for row in rows_of(tmp_path / "samples" / "samples.csv")} == building_of(models[0])
    program("sample", models[0], "--sky", "--gpu-shading-resolution=64", "-o", tmp_path / "sky")
    assert {row["receiver"] for row in rows_of(tmp_path / "sky" / "sky.csv")} == building_of(models[0])


def test_a_picture_shows_the_building(models, program, tmp_path):
    pictures = []
    for name, model in zip(("shown", "plain"), models, strict=True):
        program("view", model, "--sun", "200,30", "--size", "200", "-o", tmp_path / f"{name}.png")
        with Image.open(tmp_path / f"{name}.png") as picture:
            pictures.append(np.asarray(picture.convert("RGB")))
    assert pictures[0].shape == pictures[1].shape and (pictures[0] == pictures[1]).all()
    assert len(np.unique(pictures[0].reshape(-1, 3), axis=0)) > 20


def test_the_page_shows_the_building(models, patched, weather, tmp_path):
    reports = []
    for name, model in zip(("shown", "plain"), models, strict=True):
        reports.append(tmp_path / name)
        done = energyplus.run(patched, model, weather, tmp_path / f"{name}_run",
                              ["-D", LEAN, f"--gpu-shading-report={reports[-1]}"])
        assert done.completed, done.why()
        assert {row["receiver"] for row in rows_of(reports[-1] / "sunlit.csv")} <= building_of(model)
        assert {row["receiver"] for row in rows_of(reports[-1] / "run_receivers.csv")} == building_of(model)
    tables = [(report / "run_receivers.csv").read_text() for report in reports]
    assert tables[0] == tables[1]
    drawn = [test_run_page.content_of(report / "index.html") for report in reports]
    assert drawn[0]["names"] == drawn[1]["names"] and drawn[0]["geometry"] == drawn[1]["geometry"]


def test_a_scene_in_python_is_the_model(models, patched, weather, monkeypatch):
    gs = pytest.importorskip("gpu_shading")
    monkeypatch.setenv("GPU_SHADING_LEAN", "on")
    scene = gs.Scene.from_energyplus(models[0], weather)
    walls, windows, louvres = surfaces_of(models[0])
    assert {name for name in scene.names if " reveal " not in name} == walls | windows | louvres
    assert {scene.names[index] for index in scene.receivers} == building_of(models[0])
    plain = gs.Scene.from_energyplus(models[1], weather)
    assert scene.names == plain.names and scene.receivers == plain.receivers
    suns = [(180.0, 30.0), (120.0, 15.0)]
    assert (scene.sunlit(suns) == plain.sunlit(suns)).all()
