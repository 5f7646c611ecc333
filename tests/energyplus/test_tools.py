"""Tools that read and write models keep the extension objects, with the dictionary of the patched prefix."""

import os
import re
import shutil
import subprocess
import sys

import pytest
import screened_room
from shading_runs import energyplus
from shading_runs.version import energyplus_release

TOOLS = energyplus.REPOSITORY / ".venv" / "tools"

# Two of them import tkinter, for windows that nothing here opens.
WITHOUT_TKINTER = """
import sys, types
sys.modules["tkinter"] = types.SimpleNamespace(TclError=Exception)
"""
# Each reads a model by the dictionaries of a folder, changes the terrain, and saves it.
EDITS = {
    "eppy": """
import sys
from eppy.modeleditor import IDF
IDF.setiddname(sys.argv[1] + "/Energy+.idd")
model = IDF(sys.argv[2])
model.idfobjects["BUILDING"][0].Terrain = "City"
model.saveas(sys.argv[3])
""",
    "geomeppy": WITHOUT_TKINTER + """
from geomeppy import IDF
IDF.setiddname(sys.argv[1] + "/Energy+.idd")
model = IDF(sys.argv[2])
model.idfobjects["BUILDING"][0].Terrain = "City"
model.translate((10.0, 5.0))
model.saveas(sys.argv[3])
""",
    "idfkit": """
import json, sys
from pathlib import Path
from idfkit import EpJSONSchema, IDFParser, save_idf
schema = EpJSONSchema(RELEASE, json.loads(Path(sys.argv[1], "Energy+.schema.epJSON").read_text()))
model = IDFParser(Path(sys.argv[2]), schema=schema).parse()
model["Building"].first().terrain = "City"
save_idf(model, sys.argv[3])
""".replace("RELEASE", repr(tuple(map(int, energyplus_release().split("."))))),
}
# Edits a model and runs EnergyPlus.
BESOS = WITHOUT_TKINTER + """
from besos import eplus_funcs, eppy_funcs
prefix, model, weather, folder = sys.argv[1:]
building = eppy_funcs.get_building(model, data_dict=prefix + "/Energy+.idd")
building.idfobjects["BUILDING"][0].Terrain = "City"
eplus_funcs.run_building(building, out_dir=folder, epw=weather, ep_path=prefix, err_dir=None)
"""
# Runs a copy of the model, under another name.
HONEYBEE = """
import sys
from honeybee_energy.config import folders
from honeybee_energy.run import run_idf
prefix, model, weather = sys.argv[1:]
folders.energyplus_path = prefix
run_idf(model, weather, silent=True)
"""
# frads knows EnergyPlus's objects alone, and runs EnergyPlus to read an IDF.
FRADS = """
import os, sys
from frads.eplus import EnergyPlusSetup, load_energyplus_model
model, weather, folder = sys.argv[1:]
loaded = load_energyplus_model(model)
os.environ["GPU_SHADING"] = "1"
EnergyPlusSetup(loaded, weather).run(output_directory=folder, design_day=True)
"""
# Runs EnergyPlus by its Python package, which energyplus-api-helpers finds in a folder.
HELPERS = """
import sys
from pathlib import Path
from energyplus_api_helpers.import_helper import EPlusAPIHelper
api = EPlusAPIHelper(Path(sys.argv[1])).get_api_instance()
sys.exit(api.runtime.run_energyplus(api.state_manager.new_state(), sys.argv[2:]))
"""


def need(package):
    if not (TOOLS / package).is_dir():
        pytest.skip(f"{TOOLS / package} is missing: run scripts/setup")


def python(script, *arguments, folder, **variables):
    """Runs a script of somebody who has the tools and knows nothing of this repository."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    return subprocess.run([sys.executable, "-c", script, *map(str, arguments)], cwd=folder, text=True,
                          env=kept | {"PYTHONPATH": str(TOOLS)} | variables, capture_output=True)


@pytest.fixture
def room(tmp_path):
    model = tmp_path / "room.idf"
    model.write_text(screened_room.model(screen="small holes"))
    return model


def transmitted(run):
    assert run.completed, run.why()
    total = sum(screened_room.timesteps(run)["all"])
    assert total > 0
    return total


@pytest.mark.parametrize("tool", EDITS)
def test_a_screen_is_kept(tool, room, patched, official, weather, tmp_path):
    need(tool)
    saved = tmp_path / "saved.idf"
    done = python(EDITS[tool], patched.parent, room, saved, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "City" in saved.read_text()

    def solar(path):
        return transmitted(energyplus.run(patched, path, weather, tmp_path / path.stem, ["--gpu-shading", "-D"]))

    assert solar(saved) == pytest.approx(solar(room), rel=1e-3)
    # With the official dictionaries, which the test must tell apart, it is lost, or the model is refused.
    lost = tmp_path / "lost.idf"
    done = python(EDITS[tool], official.parent, room, lost, folder=tmp_path)
    assert done.returncode != 0 or "GPUShading" not in lost.read_text()


@pytest.fixture(scope="module")
def with_python(official, tmp_path_factory):
    """A patched folder of an EnergyPlus with its Python package."""
    package = energyplus.REPOSITORY / ".venv" / "EnergyPlus-lbnl" / "pyenergyplus"
    if not package.is_dir():
        pytest.skip(f"{package} is missing: scripts/setup could not fetch pyenergyplus-lbnl")
    folder = tmp_path_factory.mktemp("python")
    stock, prefix = folder / "EnergyPlus", folder / "EnergyPlus-gpu"
    stock.mkdir()
    for path in official.parent.iterdir():
        (stock / path.name).symlink_to(path.resolve())
    shutil.copytree(package, stock / "pyenergyplus")
    subprocess.run([energyplus.REPOSITORY / "scripts" / "patch_energyplus", stock, prefix, "--build",
                    energyplus.patched_prefix().parent], check=True, capture_output=True)
    return prefix


def test_api_helpers_are_shaded(room, with_python, patched, weather, tmp_path):
    need("energyplus_api_helpers")
    out = tmp_path / "out"
    done = python(HELPERS, with_python, "-D", "-w", weather, "-d", out, room, folder=tmp_path, GPU_SHADING="1")
    hosted = energyplus.Run(done.returncode, done.stdout, done.stderr, out, 0.0)
    direct = energyplus.run(patched, room, weather, tmp_path / "direct", ["--gpu-shading", "-D"])
    assert transmitted(hosted) == transmitted(direct)


def test_besos_runs_are_shaded(room, patched, weather, tmp_path):
    need("besos")
    room.write_text(room.read_text().replace("RunPeriod,Year,1,1,,12,31,", "RunPeriod,Day,10,21,,10,21,"))
    out = tmp_path / "out"
    done = python(BESOS, patched.parent, room, weather, out, folder=tmp_path, GPU_SHADING="1", HOME=str(tmp_path))
    hosted = energyplus.Run(done.returncode, done.stdout, done.stderr, out, 0.0)
    direct = energyplus.run(patched, room, weather, tmp_path / "direct", ["--gpu-shading"])
    assert transmitted(hosted) == pytest.approx(transmitted(direct), rel=1e-3)


def test_honeybee_runs_are_shaded(room, patched, weather, tmp_path):
    need("honeybee_energy")
    room.write_text(room.read_text().replace("RunPeriod,Year,1,1,,12,31,", "RunPeriod,Day,10,21,,10,21,"))
    folder = tmp_path / "honeybee"
    folder.mkdir()
    shutil.copy(room, folder)
    done = python(HONEYBEE, patched.parent, folder / room.name, weather, folder=tmp_path, GPU_SHADING="1",
                  HOME=str(tmp_path))
    hosted = energyplus.Run(done.returncode, done.stdout, done.stderr, folder, 0.0)
    direct = energyplus.run(patched, room, weather, tmp_path / "direct", ["--gpu-shading"])
    assert transmitted(hosted) == pytest.approx(transmitted(direct), rel=1e-3)


def test_frads_runs_are_shaded(room, with_python, patched, weather, tmp_path):
    if not (TOOLS / "frads").is_dir():
        pytest.skip("frads is not installed: with Radiance, SciPy and others it takes 200 MB, so that scripts/setup "
                    f"leaves it out: pip install --target {TOOLS} frads")
    direct = energyplus.run(patched, room, weather, tmp_path / "direct", ["--gpu-shading", "-D"])
    text = room.read_text()
    screen = re.search(r"^GPUShading:[^;]*;", text, re.M)[0]
    room.write_text(text.replace(screen, ""))
    (tmp_path / "screen.idf").write_text(screen)
    out = tmp_path / "out"
    out.mkdir()
    done = python(FRADS, room, weather, out, folder=tmp_path, GPU_SHADING_FILE=str(tmp_path / "screen.idf"),
                  PYTHONPATH=f"{with_python}:{TOOLS}")
    hosted = energyplus.Run(done.returncode, done.stdout, done.stderr, out, 0.0)
    assert transmitted(hosted) == pytest.approx(transmitted(direct), rel=1e-3)


def test_a_side_file_of_another_name_is_pointed_out(patched, weather, box, tmp_path):
    (tmp_path / "saved.idf").write_text(box)
    (tmp_path / "room.gpu-shading.idf").write_text("GPUShading:Settings,64;\n")
    line = "not read, since it does not have the model's name, saved.gpu-shading.idf: room.gpu-shading.idf"

    def lines(name):
        run = energyplus.run(patched, tmp_path / "saved.idf", weather, tmp_path / name, ["--gpu-shading", "-D"])
        assert run.completed, run.why()
        return "\n".join(run.our_lines)

    assert line in lines("without")
    (tmp_path / "saved.gpu-shading.idf").write_text("GPUShading:Settings,32;\n")
    assert "not read" not in lines("with")
