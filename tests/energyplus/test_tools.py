"""Tools that read and write models keep the extension objects, with the dictionary of the patched prefix."""

import subprocess
import sys

import pytest
import screened_room
from shading_runs import energyplus

TOOLS = energyplus.REPOSITORY / ".venv" / "tools"

EDIT = """
import sys
from eppy.modeleditor import IDF
IDF.setiddname(sys.argv[1])
model = IDF(sys.argv[2])
model.idfobjects["BUILDING"][0].Terrain = "City"
model.saveas(sys.argv[3])
"""


@pytest.fixture
def edited(tmp_path):
    """Saves a model with eppy, by a dictionary."""
    if not (TOOLS / "eppy").is_dir():
        pytest.skip(f"{TOOLS}/eppy is missing: run scripts/setup")

    def edit(dictionary, model, saved):
        subprocess.run([sys.executable, "-c", EDIT, dictionary, model, saved], check=True, cwd=tmp_path, text=True,
                       env={**energyplus.os.environ, "PYTHONPATH": str(TOOLS)}, stdout=subprocess.DEVNULL)
        return saved

    return edit


def transmitted(run):
    assert run.completed, run.why()
    total = sum(screened_room.timesteps(run)["all"])
    assert total > 0
    return total


def test_eppy_keeps_a_screen(edited, patched, official, weather, tmp_path):
    model = tmp_path / "room.idf"
    model.write_text(screened_room.model(screen="small holes"))
    saved = edited(patched.parent / "Energy+.idd", model, tmp_path / "saved.idf")
    assert "City" in saved.read_text()

    def solar(path):
        return transmitted(energyplus.run(patched, path, weather, tmp_path / path.stem, ["--gpu-shading", "-D"]))

    direct, through = solar(model), solar(saved)
    assert through == pytest.approx(direct, rel=1e-3)
    # With the official dictionary, which the test must tell apart, it is lost.
    lost = edited(official.parent / "Energy+.idd", model, tmp_path / "lost.idf")
    assert "GPUShading" not in lost.read_text()


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
