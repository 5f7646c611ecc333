"""GeometryTransform: EnergyPlus moves vertices and keeps areas and azimuths, and a warning says so."""

import math
import subprocess

import pytest
from shading_runs import energyplus

TRANSFORM = "GeometryTransform,XY,1.0,2.0;\n"
WARNING = "GeometryTransform: EnergyPlus moves vertices but keeps the areas"


@pytest.fixture
def write(box, tmp_path):
    def call(coordinates, direction, added):
        text = box.replace("Counterclockwise,World;", f"Counterclockwise,{coordinates};")
        text = text.replace("Zone,Box;", f"Zone,Box,{direction};")
        assert text.count(f"Counterclockwise,{coordinates};") == text.count(f"Zone,Box,{direction};") == 1
        path = tmp_path / "model.idf"
        path.write_text(text + added + "Output:Surfaces:List,DetailsWithVertices;\n")
        return path

    return call


def warnings_of(patched, weather, model):
    """(lines of check, of the run's .err and of its standard error that are the warning)."""
    check = subprocess.run([patched.parent / "gpu_shading", "check", model], capture_output=True, text=True)
    assert check.returncode == 0, check.stderr
    folder = model.parent / "run"
    run = subprocess.run([patched, "--gpu-shading", "-D", "-w", weather, "-d", folder, model], capture_output=True,
                         text=True)
    assert run.returncode == 0, run.stderr
    return [[line for line in text.splitlines() if WARNING in line]
            for text in (check.stdout, (folder / "eplusout.err").read_text(), run.stderr)]


def south_wall(run):
    """(area, azimuth) that EnergyPlus reports, and those of the vertices that it reports."""
    for line in (run.folder / "eplusout.eio").read_text().splitlines():
        cells = line.split(",")
        if cells[:2] == ["HeatTransfer Surface", "SOUTH"]:
            break
    xyz = [float(cell) for cell in cells[-12:]]
    corners = [xyz[i:i + 3] for i in range(0, 12, 3)]
    along = [b - a for a, b in zip(corners[1], corners[2], strict=True)]
    height = corners[0][2] - corners[1][2]
    azimuth = math.degrees(math.atan2(along[1], -along[0])) % 360
    return (float(cells[10]), float(cells[12])), (math.hypot(*along) * height, azimuth)


@pytest.mark.parametrize("direction", [0, 30])
def test_a_transformed_model_is_warned_of(patched, official, weather, write, direction):
    model = write("Relative", direction, TRANSFORM)
    stock = energyplus.run(official, model, weather, model.parent / "stock", ["-D"])
    assert stock.completed, stock.why()
    (area, azimuth), (drawn_area, drawn_azimuth) = south_wall(stock)
    # What the warning says is true of stock EnergyPlus.
    assert area == pytest.approx(18.0) and drawn_area > 22.0
    assert azimuth == pytest.approx(180.0 + direction, abs=0.01)
    assert abs(drawn_azimuth - azimuth) > 10.0 if direction else drawn_azimuth == pytest.approx(azimuth, abs=0.1)
    for lines in warnings_of(patched, weather, model):
        assert len(lines) == 1
        assert ("turned zones such as BOX, the azimuths" in lines[0]) == (direction != 0)


@pytest.mark.parametrize("coordinates, added", [("World", TRANSFORM), ("Relative", TRANSFORM.replace("1.0", "2.0")),
                                                ("Relative", "")], ids=["world", "same ratio", "none"])
def test_where_nothing_moves_nothing_is_said(patched, weather, write, coordinates, added):
    assert warnings_of(patched, weather, write(coordinates, 30, added)) == [[], [], []]
