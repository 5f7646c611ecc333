"""gpu_shading map: against EnergyPlus's own beam, closed forms, and another ray tracer."""

import csv
import json
import math
import os
import shutil
import sqlite3
import subprocess
import sys

import pytest
import screened_room
from output_files import rows_of
from shading_runs import energyplus, input_file

INCIDENT = "Surface Outside Face Incident Beam Solar Radiation Rate per Area"
SITE = ("Site Solar Azimuth Angle", "Site Solar Altitude Angle", "Site Direct Solar Radiation Rate per Area")


def of_period(path, begin, end, update="Timestep", method="PolygonClipping"):
    """The model with one run period from begin to end, (month, day) each, and its beam at each timestep."""
    model = input_file.read(path)
    model.remove(lambda name: name in ("runperiod", "shadowcalculation", "output:variable"))
    model.add("RunPeriod", ["Period", *begin, "", *end, "", "Sunday"])
    model.add("ShadowCalculation", [method, update, ""])
    model.add_unique("Output:SQLite", ["Simple"], ["option_type"])
    model.add_output_variable(INCIDENT, "Timestep")
    return model


def call(*arguments, folder=None):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    command = [energyplus.patched_prefix() / "gpu_shading", "map", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder)


def draw(model, weather, folder, *arguments):
    done = call(model, "-w", weather, "-o", folder, *arguments)
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"{folder}/maps.csv\n"
    return folder


def energies_of(folder):
    """{receiver: kWh/m2} of maps."""
    return {row["receiver"]: float(row["beam mean [kWh/m2]"]) for row in rows_of(folder / "maps.csv")}


def beams_of(run, steps_per_hour=4):
    """{surface: kWh/m2} of a run."""
    query = """SELECT d.KeyValue, SUM(r.Value) FROM ReportData r JOIN ReportDataDictionary d
               USING (ReportDataDictionaryIndex) WHERE d.Name = ? GROUP BY d.KeyValue"""
    with sqlite3.connect(run.folder / "eplusout.sql") as data:
        sums = dict(data.execute(query, (INCIDENT,)))
    data.close()
    return {name: value / steps_per_hour / 1000.0 for name, value in sums.items()}


def compare(ours, theirs, least):
    """Those with a beam, within 0.5 % of it, and how many."""
    lit = {name: theirs[name] for name in ours if theirs[name] > least}
    worst = {name: ours[name] / beam - 1 for name, beam in lit.items()}
    print({name: f"{error:+.3%}" for name, error in worst.items()})
    assert max(map(abs, worst.values())) < 0.005, worst
    return len(lit)


def test_courtyard_gets_the_beam_of_energyplus(official, courtyard, weather, tmp_path):
    """Of EnergyPlus itself, with polygon clipping."""
    of_period(courtyard, (6, 20), (6, 25)).write(tmp_path / "model.idf")
    run = energyplus.run(official, tmp_path / "model.idf", weather, tmp_path / "run")
    assert run.completed, run.why()
    folder = draw(tmp_path / "model.idf", weather, tmp_path / "maps", "--from", "06-20", "--to", "06-25",
                  "--rays", "16")
    assert compare(energies_of(folder), beams_of(run), 0.1) == 18


def test_scheduled_transparent_canopy(patched, weather, tmp_path):
    """Panes of glass on a schedule, as in a run."""
    generate = energyplus.REPOSITORY / "idf_examples" / "canopy" / "generate.py"
    text = subprocess.run([sys.executable, generate], capture_output=True, text=True, check=True).stdout
    path = tmp_path / "canopy.idf"
    path.write_text(text)
    model = of_period(path, (10, 1), (10, 2))
    model.add("Schedule:Compact", ["Cleaning", "", "Through: 12/31", "For: AllDays", "Until: 12:00", "0.5",
                                   "Until: 24:00", "0.9"])
    model.add("Shading:Building:Detailed", ["Awning", "Cleaning", 4, -8, -9, 4, -8, -5, 4, 0, -5, 4, 0, -9, 4])
    model.write(path)
    run = energyplus.run(patched, path, weather, tmp_path / "run", ["--gpu-shading"])
    assert run.completed, run.why()
    folder = draw(path, weather, tmp_path / "maps", "--from", "10-01", "--to", "10-02", "--spacing", "0.5")
    assert compare(energies_of(folder), beams_of(run), 0.1) == 9


MOVING = """
Schedule:Compact,Moving,,Through: 12/31,For: AllDays,Until: 11:00,0.3,Until: 24:00,1;
GPUShading:PerforatedScreen,Sheet,Screen,Round,,Staggered60,0.006,,0.009,,0.003,,,,,,,,,,,Moving;
"""


PYRAMID = """o Pyramid
v 1 -3 0\nv 4 -3 0\nv 2.5 -1.5 0\nv 2.5 -2.4 3.5
f 1 2 4\nf 2 3 4\nf 3 1 4
"""


def test_screened_room_with_a_moving_screen_and_a_mesh(patched, weather, tmp_path):
    path = tmp_path / "room.idf"
    (tmp_path / "pyramid.obj").write_text(PYRAMID)
    path.write_text(screened_room.model(objects=screened_room.rectangle("Screen", -0.4) + MOVING
                                        + "GPUShading:Geometry,Pyramid,pyramid.obj,m,Z;\n"))
    of_period(path, (10, 1), (10, 3)).write(path)
    run = energyplus.run(patched, path, weather, tmp_path / "run", ["--gpu-shading"])
    assert run.completed, run.why()
    folder = draw(path, weather, tmp_path / "maps", "--from", "10-01", "--to", "10-03", "--rays", "16")
    assert compare(energies_of(folder), beams_of(run), 0.1) == 2


def suns_of(run):
    """[(azimuth, altitude in radians, direct normal W/m2)] of a run's timesteps with the sun up."""
    query = """SELECT d.Name, r.Value FROM ReportData r JOIN ReportDataDictionary d USING (ReportDataDictionaryIndex)
               WHERE d.Name LIKE 'Site %' ORDER BY r.TimeIndex"""
    columns = {}
    with sqlite3.connect(run.folder / "eplusout.sql") as data:
        for name, value in data.execute(query):
            columns.setdefault(name, []).append(value)
    data.close()
    rows = zip(*(columns[name] for name in SITE), strict=True)
    return [(math.radians(azimuth), math.radians(altitude), beam) for azimuth, altitude, beam in rows if altitude > 0]


def covered(low, high, a, b):
    """The fraction of low .. high that lies between a and b."""
    return max(0.0, min(high, max(a, b)) - max(low, min(a, b))) / (high - low)


FAR = 500.0
LEDGE = (f"Shading:Site:Detailed,Ledge,,4, {FAR},0,2.7, -{FAR},0,2.7, -{FAR},-1.3,2.7, {FAR},-1.3,2.7;\n"
         f"Shading:Site:Detailed,Fin,,4, 3.3,-0.7,-{FAR}, 3.3,0,-{FAR}, 3.3,0,{FAR}, 3.3,-0.7,{FAR};\n")


def test_ledge_and_fin_in_closed_form(official, weather, tmp_path):
    """Their shadows are a strip across the wall and one up it: what is lit of a cell is a product."""
    path = tmp_path / "room.idf"
    path.write_text(screened_room.model(objects=LEDGE))
    model = of_period(path, (10, 6), (10, 6))
    for name in SITE:
        model.add_output_variable(name, "Timestep")
    model.write(path)
    run = energyplus.run(official, path, weather, tmp_path / "run")
    assert run.completed, run.why()
    folder = draw(path, weather, tmp_path / "maps", "--from", "10-06", "--to", "10-06", "--spacing", "0.2",
                  "--rays", "64", "--receivers", "Front")
    cells = rows_of(folder / "FRONT.csv")
    assert len(cells) == 30 * 15 - 20 * 9  # the window lies on the grid
    errors = []
    for cell in cells:
        x, z = (0.2 * int(cell[name]) for name in ("column", "row"))
        assert (float(cell["x [m]"]), float(cell["z [m]"])) == pytest.approx((x + 0.1, z + 0.1), abs=1e-5)
        hours = energy = 0.0
        for azimuth, altitude, beam in suns_of(run):
            towards = -math.cos(azimuth)  # the part of the horizontal way to the sun that leaves the wall
            if towards <= 0:
                continue
            strip = 1.3 * math.tan(altitude) / towards
            side = 0.7 * math.sin(azimuth) / towards
            lit = (1 - covered(z, z + 0.2, 2.7 - strip, 2.7)) * (1 - covered(x, x + 0.2, 3.3 - side, 3.3))
            hours += lit / 4
            energy += lit / 4 * beam * math.cos(altitude) * towards / 1000
        errors.append((float(cell["sunlit [h]"]) - hours, float(cell["beam [kWh/m2]"]) - energy))
    hours, energies = ([abs(error[i]) for error in errors] for i in (0, 1))
    print(f"hours: mean {sum(hours) / len(hours):.4f}, most {max(hours):.4f}; "
          f"kWh/m2: mean {sum(energies) / len(energies):.5f}, most {max(energies):.5f}")
    assert max(hours) < 0.03 and max(energies) < 0.02


TOOLS = energyplus.REPOSITORY / ".venv" / "tools"


def outlines_of(model):
    """{surface: its corners}."""
    done = subprocess.run([energyplus.patched_prefix() / "gpu_shading", "check", "--vertices", model],
                          capture_output=True, text=True, check=True)
    outlines = {}
    for row in csv.DictReader(done.stdout.splitlines()):
        outlines.setdefault(row["surface"], []).append([float(row[f"{axis} [m]"]) for axis in "xyz"])
    return outlines


def embree_of(model):
    """The surfaces of a model in Embree."""
    sys.path.append(str(TOOLS))
    embree = pytest.importorskip("embreex.rtcore_scene", reason="embreex is missing: run scripts/setup")
    mesh = pytest.importorskip("embreex.mesh_construction")
    import numpy

    # Triangles from the first corner, which is wrong for the roofs, with their notch: no ray from below meets a roof
    # without meeting a wall.
    corners = numpy.array([[ring[0], ring[i], ring[i + 1]] for name, ring in outlines_of(model).items()
                           if not name.endswith("ROOF") for i in range(1, len(ring) - 1)], dtype=numpy.float32)
    scene = embree.EmbreeScene()
    mesh.TriangleMesh(scene, corners)
    return scene


def hours_by_embree(scene, cells, size, axes, suns, numpy):
    """Of each cell by 200 rays to each sun, at 4 timesteps an hour."""
    u, v, normal = (numpy.array(axis, dtype=float) for axis in axes)
    # A lattice (Fibonacci's), in which no two places are side by side.
    places = [((i + 0.5) / 200 - 0.5, i * 0.6180339887 % 1 - 0.5) for i in range(200)]
    grid = numpy.array([size[0] * a * u + size[1] * b * v for a, b in places])
    centres = numpy.array([[float(cell[f"{axis} [m]"]) for axis in "xyz"] for cell in cells])
    origins = (centres[:, None, :] + grid[None, :, :] + 1e-3 * normal).reshape(-1, 3).astype(numpy.float32)
    hours = numpy.zeros(len(cells))
    for azimuth, altitude, _ in suns:
        sun = numpy.array([math.sin(azimuth) * math.cos(altitude), math.cos(azimuth) * math.cos(altitude),
                           math.sin(altitude)])
        if sun @ normal > 0:
            hits = scene.run(origins, numpy.tile(sun.astype(numpy.float32), (len(origins), 1)))
            hours += (hits < 0).reshape(len(cells), -1).mean(axis=1) / 4
    return hours


def test_each_cell_is_as_embree_has_it(official, courtyard, weather, tmp_path):
    numpy = pytest.importorskip("numpy")
    scene = embree_of(courtyard)
    model = of_period(courtyard, (3, 14), (3, 15))
    for name in SITE:
        model.add_output_variable(name, "Timestep")
    model.write(tmp_path / "model.idf")
    run = energyplus.run(official, tmp_path / "model.idf", weather, tmp_path / "run")
    assert run.completed, run.why()
    suns = suns_of(run)
    folder = draw(tmp_path / "model.idf", weather, tmp_path / "maps", "--from", "03-14", "--to", "03-15",
                  "--rays", "32", "--spacing", "0.5", "--receivers", "* Court *")
    for row in rows_of(folder / "maps.csv"):
        cells = rows_of(folder / f"{row['files']}.csv")
        size = float(row["cell width [m]"]), float(row["cell height [m]"])
        azimuth = math.radians(float(row["azimuth [deg]"]))
        normal = math.sin(azimuth), math.cos(azimuth), 0.0
        whole = [cell for cell in cells if float(cell["area [m2]"]) > 0.9999 * size[0] * size[1]]
        theirs = hours_by_embree(scene, whole, size, ((-normal[1], normal[0], 0), (0, 0, 1), normal), suns, numpy)
        errors = numpy.abs(theirs - numpy.array([float(cell["sunlit [h]"]) for cell in whole]))
        print(f"{row['receiver']}: {len(whole)} cells, mean {theirs.mean():.2f} h, differ by {errors.mean():.4f} h, "
              f"at most {errors.max():.4f} h")
        assert errors.mean() < 0.06 and errors.max() < 0.2


@pytest.fixture(scope="session")
def box_maps(patched, box, weather, tmp_path_factory):
    """The model of a box, and its maps of one day."""
    path = tmp_path_factory.mktemp("box") / "box.idf"
    path.write_text(box)
    return path, draw(path, weather, path.parent / "maps", "--from", "12-21", "--to", "12-21")


def test_tables_arrays_and_pictures_agree(box_maps):
    numpy = pytest.importorskip("numpy")
    image = pytest.importorskip("PIL.Image", reason="Pillow is missing: run scripts/setup")
    model, folder = box_maps
    about = json.loads((folder / "maps.json").read_text())
    assert (about["model"], about["from"], about["to"], about["steps_per_hour"]) == (model.name, "12-21", "12-21", 4)
    listed = rows_of(folder / "maps.csv")
    names = {f"{row['files']}{ending}" for row in listed for ending in (".csv", ".npy", ".png")} | {"maps.csv"}
    assert set(about["files"]) == names == {path.name for path in folder.iterdir()} - {"maps.json"}
    for row in listed:
        cells = rows_of(folder / f"{row['files']}.csv")
        area = sum(float(cell["area [m2]"]) for cell in cells)
        assert area == pytest.approx(float(row["area [m2]"]), rel=1e-5) and len(cells) == int(row["cells"])
        values = numpy.load(folder / f"{row['files']}.npy")
        assert numpy.isfinite(values).sum() == 2 * len(cells)
        for plane, name, mean in ((0, "sunlit [h]", "sunlit mean [h]"), (1, "beam [kWh/m2]", "beam mean [kWh/m2]")):
            for cell in cells:
                found = values[plane, int(cell["row"]), int(cell["column"])]
                assert found == pytest.approx(float(cell[name]), rel=1e-5, abs=1e-9)
            total = sum(float(cell[name]) * float(cell["area [m2]"]) for cell in cells)
            assert total / area == pytest.approx(float(row[mean]), rel=1e-4, abs=1e-6)
        picture = image.open(folder / f"{row['files']}.png")
        assert picture.mode == "RGB" and min(picture.size) > 300


def test_maps_are_replaced_and_files_of_others_are_not(box_maps, weather, tmp_path):
    model, made = box_maps
    folder = shutil.copytree(made, tmp_path / "maps")
    names = sorted(path.name for path in folder.iterdir())
    arguments = [model, "-w", weather, "-o", folder, "--from", "12-21", "--to", "12-21", "--receivers"]
    one = rows_of(folder / "maps.csv")[0]
    draw(model, weather, folder, "--from", "12-21", "--to", "12-21", "--receivers", one["receiver"])
    stem = one["files"]
    assert sorted(path.name for path in folder.iterdir()) == sorted(
        [f"{stem}.csv", f"{stem}.npy", f"{stem}.png", "maps.csv", "maps.json"])
    assert len(names) > 5
    table = folder / f"{stem}.csv"
    table.write_text("notes of somebody\n")
    done = call(*arguments, one["receiver"])
    assert done.returncode == 1
    assert f"{table}: exists and is not an unchanged file that maps.json lists" in done.stderr
    assert table.read_text() == "notes of somebody\n"


@pytest.mark.parametrize("arguments, words", [
    ((), "-w: a weather file is required (it sets site, calendar and beam radiation)"),
    (("-w", "none.epw"), "-w none.epw: no such file"),
    (("-w", "WEATHER", "--from", "June"), '--from "June": expected month and day, as in 06-21'),
    (("-w", "WEATHER", "--to", "02-30"), '--to "02-30": expected month and day'),
    (("-w", "WEATHER", "--spacing", "0"), "--spacing: Value 0 not in range"),
    (("-w", "WEATHER", "--rays", "0"), "--rays: Value 0 not in range"),
    (("-w", "WEATHER", "--recievers", "*"), "--recievers: no such flag; did you mean --receivers?"),
    (("-w", "WEATHER", "--from", "06-21", "--to", "06-21", "--receivers", "Windo"),
     '--receivers "Windo": no exterior or shading surface matches'),
    (("-w", "WEATHER", "--from", "06-21", "--to", "06-21", "--spacing", "0.001"), "has more than 1000000 cells of"),
])
def test_errors_name_the_argument(patched, box, weather, tmp_path, arguments, words):
    (tmp_path / "box.idf").write_text(box)
    done = call("box.idf", "-o", "out", *(weather if word == "WEATHER" else word for word in arguments),
                folder=tmp_path)
    assert done.returncode == 1
    lines = [line for line in done.stderr.splitlines() if "error: " in line]
    assert len(lines) == 1 and words in lines[0], done.stderr
    assert not [*tmp_path.glob("out/*.*")]


def test_a_folder_of_others_is_refused(patched, box, weather, tmp_path):
    (tmp_path / "box.idf").write_text(box)
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "mine.txt").write_text("mine")
    done = call("box.idf", "-w", weather, "-o", "out", folder=tmp_path)
    assert "gpu_shading: error: out: is not empty and has no maps.json: choose another folder" in done.stderr
    (tmp_path / "out" / "maps.json").write_text('{"format": "another"}')
    done = call("box.idf", "-w", weather, "-o", "out", folder=tmp_path)
    assert 'out/maps.json: is not a list of "gpu_shading maps 1": choose another folder' in done.stderr
