"""The OpenStudio measure: its objects reach EnergyPlus, and the patched EnergyPlus is the one that runs."""

import json
import re
import subprocess
import sys

import pytest
import screened_room
from large_packages import environment, need
from shading_runs import energyplus
from shading_runs.version import input_version

MEASURES = energyplus.REPOSITORY / "gpu_shading" / "python" / "gpu_shading" / "measures"
# As a step of an OpenStudio workflow: the measure changes a workspace, which is then written for the run.
STEP = """
import importlib.util, json, os, sys
import openstudio
model, folder, file, given = sys.argv[1:]
workflow = openstudio.WorkflowJSON()
workflow.setOswDir(openstudio.path(folder))
runner = openstudio.measure.OSRunner(workflow)
spec = importlib.util.spec_from_file_location("measure", file)
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
measure = module.RenderShading()
arguments = openstudio.measure.convertOSArgumentVectorToMap(measure.arguments())
for name, value in json.loads(given).items():
    argument = arguments[name]
    assert argument.setValue(value)
    arguments[name] = argument
workspace = openstudio.Workspace.load(openstudio.path(model), openstudio.IddFileType("EnergyPlus")).get()
done = measure.run(workspace, runner, arguments)
run = str(workflow.absoluteRunDir())
os.makedirs(run, exist_ok=True)
workspace.save(openstudio.path(run + "/in.idf"), True)
print(json.dumps({"done": done, "errors": list(runner.result().stepErrors()), "run": run,
                  "program": str(openstudio.getEnergyPlusExecutable()), "on": os.environ.get("GPU_SHADING")}))
"""
IMAGE = "GPUShading:PerforatedScreen,Image,Sheet,Texture,tile.png,,,,,,0.001;\n"


@pytest.fixture
def room(tmp_path):
    """(model, side file) of a room behind a screen on one day in October."""
    text = screened_room.model(screen="small holes")
    text = text.replace("RunPeriod,Year,1,1,,12,31,", "RunPeriod,Day,10,21,,10,21,")
    screen = re.search(r"^GPUShading:[^;]*;", text, re.M)[0]
    model, side = tmp_path / "room.idf", tmp_path / "sheets.idf"
    model.write_text(text.replace(screen, ""))
    side.write_text(f"Version, {input_version()};\n! What OpenStudio cannot know; with ; in a comment\n" + screen)
    return model, side


def step(model, folder, **given):
    need("openstudio")
    folder.mkdir(exist_ok=True)
    done = subprocess.run([sys.executable, "-c", STEP, model, folder, MEASURES / "render_shading" / "measure.py",
                           json.dumps({name: str(value) for name, value in given.items()})], env=environment(folder),
                          cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_its_objects_reach_energyplus(room, patched, weather, tmp_path):
    model, side = room
    said = step(model, tmp_path / "workflow", prefix=patched.parent, objects=side)
    assert said["done"] and said["program"] == str(patched) and said["on"] == "1"
    # OpenStudio runs `energyplus in.idf` in this folder, with in.epw beside it.
    run = energyplus.Path(said["run"])
    (run / "in.epw").symlink_to(weather)
    assert "Catchall,\n  GPUShading:PerforatedScreen," in (run / "in.idf").read_text()
    done = subprocess.run([said["program"], "in.idf"], cwd=run, env=environment(tmp_path, GPU_SHADING=said["on"]),
                          capture_output=True, text=True)
    hosted = energyplus.Run(done.returncode, done.stdout, done.stderr, run, 0.0)
    direct = energyplus.run(patched, model, weather, tmp_path / "direct",
                            ["--gpu-shading", f"--gpu-shading-file={side}"])
    for each in (hosted, direct):
        assert each.completed, each.why()
    found, expected = (screened_room.timesteps(each)["all"] for each in (hosted, direct))
    assert sum(expected) > 0
    # OpenStudio writes numbers of the model with fewer digits.
    assert found == pytest.approx(expected, rel=1e-3, abs=1e-3)
    bare = energyplus.run(patched, model, weather, tmp_path / "bare", ["--gpu-shading"])
    assert sum(screened_room.timesteps(bare)["all"]) != pytest.approx(sum(expected), rel=0.1)


def test_files_that_objects_name_come_along(room, patched, tmp_path):
    model, side = room
    side.write_text(IMAGE)
    (tmp_path / "tile.png").write_bytes(b"image")
    said = step(model, tmp_path / "workflow", prefix=patched.parent, objects=side)
    assert said["done"] and (energyplus.Path(said["run"]) / "tile.png").read_bytes() == b"image"


def test_its_errors_are_one_line(room, patched, tmp_path):
    model, side = room
    said = step(model, tmp_path / "a", prefix=tmp_path)
    assert not said["done"] and said["errors"] == [
        f"prefix: {tmp_path} is not a folder that patch_energyplus created"]
    side.write_text("Zone, Core;\n")
    said = step(model, tmp_path / "b", prefix=patched.parent, objects=side)
    assert not said["done"] and said["errors"] == [
        f"objects: {side}: Zone: only GPUShading:... objects belong in this file"]


def test_its_description_is_that_of_its_code(tmp_path):
    """measure.xml has checksums by which OpenStudio notices a change: `openstudio measure -u` renews it."""
    need("openstudio")
    code = ("import openstudio, sys\n"
            "measures = openstudio.BCLMeasure.getMeasuresInDir(openstudio.path(sys.argv[1]))\n"
            "for each in measures: print(each.className(), each.checkForUpdatesFiles(), each.checkForUpdatesXML())\n")
    done = subprocess.run([sys.executable, "-c", code, MEASURES], env=environment(tmp_path), capture_output=True,
                          text=True)
    assert done.stdout == "RenderShading False False\n", done.stdout + done.stderr
