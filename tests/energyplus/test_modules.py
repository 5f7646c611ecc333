"""gpu_shading modules: cells of photovoltaic modules against closed forms and a ray tracer of this file."""

import json
import math
import os
import subprocess
import sys

import numpy as np
import pytest
from html_page import look_at
from output_files import rows_of
from shading_runs import energyplus

sys.path.insert(0, str(energyplus.REPOSITORY / "gpu_shading" / "python"))
EXAMPLE = energyplus.REPOSITORY / "idf_examples" / "pv_roof" / "pv_roof.idf"
HALL = EXAMPLE.read_text().partition("! The parapet")[0]  # without shading surfaces
# A level deck above the roof: 10 x 2 modules of 1 m x 1.6 m without frames and gaps.
DECK = """
Shading:Building:Detailed,Deck,,4, 1,4.2,5, 1,1,5, 11,1,5, 11,4.2,5;
GPUShading:PVModules,Modules,Deck,1,1.6,,6,10,3,0,0,,,10;
"""


def call(*arguments):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    command = [energyplus.patched_prefix() / "gpu_shading", "modules", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=environment)


class Shaded:
    """What the command writes of a model, given as text."""

    def __init__(self, text, weather, folder, *arguments):
        (folder / "model.idf").write_text(text)
        done = call(folder / "model.idf", "-w", weather, "-o", folder / "out", *arguments)
        assert done.returncode == 0, done.stderr
        assert done.stdout == f"{folder / 'out'}/modules.csv\n"
        self.folder = folder / "out"
        self.modules = rows_of(self.folder / "modules.csv")
        self.strings = rows_of(self.folder / "strings.csv")
        self.times = rows_of(self.folder / "times.csv")
        angles = np.radians([[float(row[f"sun {name} [deg]"]) for name in ("azimuth", "altitude")]
                             for row in self.times])
        azimuth, altitude = angles.T
        self.suns = np.stack([np.sin(azimuth) * np.cos(altitude), np.cos(azimuth) * np.cos(altitude),
                              np.sin(altitude)], axis=1)
        self.beam = np.array([float(row["beam [W/m2]"]) for row in self.times])

    def cells(self, stem):
        return np.load(self.folder / f"{stem}.npy") / 65535


def clipped(polygon, low, high):
    """The part of a flat polygon inside a rectangle (Sutherland and Hodgman 1974)."""
    for axis in (0, 1):
        for limit, side in ((low[axis], 1), (high[axis], -1)):
            kept = []
            for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True):
                before, after = side * (a[axis] - limit), side * (b[axis] - limit)
                if before >= 0:
                    kept.append(a)
                if (before >= 0) != (after >= 0):
                    share = before / (before - after)
                    kept.append(tuple(a[i] + share * (b[i] - a[i]) for i in (0, 1)))
            polygon = kept
    return polygon


def area(polygon):
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True))) / 2


def test_the_shadow_of_a_pole_in_closed_form(patched, weather, tmp_path):
    left, right, y, height = 5.83, 6.04, 0.7, 2.2
    pole = (f"Shading:Building:Detailed,Pole,,4, {left},{y},{5 + height}, {left},{y},5, {right},{y},5, "
            f"{right},{y},{5 + height};\n")
    shaded = Shaded(HALL + DECK + pole, weather, tmp_path, "--from", "03-21", "--to", "03-21")
    cells = shaded.cells("DECK")
    assert cells.shape == (len(shaded.times), 20, 10, 6)
    worst, partly = 0.0, 0
    for sun, lit in zip(shaded.suns, cells, strict=True):
        # From the foot, the shadow runs away from the sun on the level of the deck.
        along = -height / sun[2] * sun[:2]
        shadow = [(left, y), (right, y), (right + along[0], y + along[1]), (left + along[0], y + along[1])]
        for module in range(20):
            for row in range(10):
                for column in range(6):
                    low = (1 + module % 10 + column / 6, 1 + 1.6 * (module // 10) + 0.16 * row)
                    high = (low[0] + 1 / 6, low[1] + 0.16)
                    part = clipped(shadow, low, high)
                    expected = 1 - area(part) * 6 / 0.16 if len(part) > 2 else 1
                    worst = max(worst, abs(lit[module, row, column] - expected))
                    partly += 0.01 < expected < 0.99
    print(f"{len(shaded.times)} times, {partly} partly shaded cells: largest difference {worst:.6f}")
    assert partly > 500 and worst < 1e-3
    # Strings and blocks follow from the cells.
    for row in shaded.strings:
        at = next(i for i, time in enumerate(shaded.times)
                  if all(row[name] == time[name] for name in ("month", "day", "hour", "timestep")))
        string = cells[at, 10 * int(row["string"]) - 10:10 * int(row["string"])]
        assert float(row["sunlit fraction"]) == pytest.approx(string.mean(), abs=1e-5)
        assert int(row["blocks"]) == 30
        # Two columns of cells to a bypass diode.
        blocks = string.reshape(10, 10, 3, 2).min(axis=(1, 3))
        assert int(row["shaded blocks"]) == (blocks < 0.999).sum()


def quads(text):
    """Rectangles of Shading:Building:Detailed: (corner, side, side) in rows."""
    found = []
    for part in text.split("Shading:Building:Detailed,")[1:]:
        numbers = [float(number) for number in part.partition(";")[0].split(",")[3:]]
        corners = np.array(numbers).reshape(4, 3)
        found.append((corners[1], corners[2] - corners[1], corners[0] - corners[1]))
    return found


def blocked(origins, sun, casters):
    """Whether rays from points to the sun meet a rectangle."""
    stopped = np.zeros(len(origins), bool)
    for corner, u, v in casters:
        normal = np.cross(u, v)
        facing = sun @ normal
        if abs(facing) < 1e-12:
            continue
        distance = (corner - origins) @ normal / facing
        met = origins + distance[:, None] * sun - corner
        inside = [(met @ side >= 0) & (met @ side <= side @ side) for side in (u, v)]
        stopped |= (distance > 1e-6) & inside[0] & inside[1]
    return stopped


def test_a_roof_over_a_year_against_rays(patched, weather, tmp_path):
    shaded = Shaded(EXAMPLE.read_text().replace("Timestep,4", "Timestep,1"), weather, tmp_path)
    cells = shaded.cells("ROW_2")
    assert cells.shape == (len(shaded.times), 10, 10, 6)
    casters = quads(EXAMPLE.read_text())
    own = next(i for i, (corner, _, _) in enumerate(casters) if corner[1] == 3.8)
    corner, u, v = casters.pop(own)
    # 10 modules of 1 m x 1.65 m, 0.02 m apart and with frames of 0.02 m, in the middle of the row.
    side = 6
    within = (np.arange(side) + 0.5) / side
    across = 0.01 + 1.02 * np.arange(10)[:, None] + 0.02 + 0.16 * np.arange(6)
    up = 0.005 + 0.02 + 0.161 * np.arange(10)
    x = (across[:, None, :, None, None] + 0.16 * within[None, None, None, :, None]) / np.linalg.norm(u)
    z = (up[None, :, None, None, None] + 0.161 * within[None, None, None, None, :]) / np.linalg.norm(v)
    x, z = np.broadcast_arrays(x, z)
    points = corner + x.reshape(-1, 1) * u + z.reshape(-1, 1) * v
    normal = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
    # The roof and its walls are below the row.
    bright = [i for i in range(0, len(shaded.times), 7) if shaded.suns[i] @ normal > 0.01]
    differences, sums = [], np.zeros(2)
    for i in bright:
        lit = 1 - blocked(points, shaded.suns[i], casters).reshape(10, 10, 6, side * side).mean(axis=-1)
        differences.append(np.abs(lit - cells[i]))
        sums += shaded.beam[i] * (shaded.suns[i] @ normal) * np.array([lit.mean(), cells[i].mean()])
    differences = np.array(differences)
    partly = np.array([(cells[i] > 0.05) & (cells[i] < 0.95) for i in bright])
    print(f"{len(bright)} times, {partly.sum()} partly shaded cells: mean difference {differences.mean():.5f}, "
          f"of partly shaded ones {differences[partly].mean():.4f}; beam {sums[1] / sums[0] - 1:+.2e}")
    # A ray in 36 is 0.028.
    assert partly.sum() > 5000 and differences[partly].mean() < 0.02 and differences.max() < 0.15
    assert sums[1] == pytest.approx(sums[0], rel=2e-4)
    # modules.csv has the sums of the whole year.
    facing = np.maximum(shaded.suns @ normal, 0.0)
    yearly = (shaded.beam * facing) @ cells.mean(axis=(2, 3)) / 1000
    rows = [row for row in shaded.modules if row["surface"] == "ROW 2"]
    assert [float(row["beam [kWh/m2]"]) for row in rows] == pytest.approx(yearly, rel=1e-4)
    assert float(rows[0]["unshaded beam [kWh/m2]"]) == pytest.approx((shaded.beam * facing).sum() / 1000, rel=1e-4)


def test_a_transparent_shade_dims_all_cells_and_a_long_wall_takes_sky(patched, weather, tmp_path):
    # Above the deck, and a wall of 3 m along its south.
    shades = """
Shading:Building:Detailed,Sail,,4, -90,90,8, -90,-90,8, 90,-90,8, 90,90,8;
GPUShading:TransparentShade,Cloth,Sail,Constant,0.4;
"""
    wall = "Shading:Building:Detailed,Wall,,4, 9000,0,8, 9000,0,5, -9000,0,5, -9000,0,8;\n"
    (tmp_path / "sail").mkdir()
    dimmed = Shaded(HALL + DECK + shades, weather, tmp_path / "sail", "--from", "06-21", "--to", "06-21")
    noon = max(range(len(dimmed.times)), key=lambda i: dimmed.suns[i][2])
    assert dimmed.cells("DECK")[noon] == pytest.approx(0.4, abs=1e-4)
    # A level strip sees (1 + cos a) / 2 of the sky, a being the angle up to the wall's top.
    walled = Shaded(HALL + DECK + wall, weather, tmp_path, "--from", "06-21", "--to", "06-21")
    for row in walled.modules:
        expected = np.mean([(1 + math.cos(math.atan2(3, float(row["y [m]"]) + 1.6 * (k / 50 - 0.49)))) / 2
                            for k in range(50)])
        assert float(row["sky view factor"]) == pytest.approx(expected, abs=0.015)
        assert float(row["unshaded view factor"]) == pytest.approx(1.0, abs=0.003)


LOOK = """() => {
  const titles = (id) => [...document.querySelectorAll(`#${id} title`)].map((title) => title.textContent);
  const fills = [...document.querySelectorAll("#field-plot rect")].map((box) => box.getAttribute("fill"));
  const choose = (id, value) => {
    document.getElementById(id).value = value;
    document.getElementById(id).dispatchEvent(new Event("change"));
  };
  const seen = {faults: faults(), hidden: document.getElementById("modules").hidden, fills};
  choose("module-surface", 1);
  const lost = document.getElementById("field-loss").textContent;
  Object.assign(seen, {modules: titles("field-plot"), lost, first: titles("string-plot")});
  document.querySelectorAll("#field-plot rect")[7].dispatchEvent(new Event("click"));
  Object.assign(seen, {chosen: document.getElementById("module-string").value, second: titles("string-plot"),
    texts: [document.getElementById("modules").textContent]});
  return seen;
}"""


def one_day(text):
    assert "RunPeriod,Year,1,1,,12,31" in text
    return text.replace("RunPeriod,Year,1,1,,12,31", "RunPeriod,Days,12,20,,12,20")


MONTHS = {12: "December"}


def test_modules_are_on_the_page_of_a_run(patched, weather, tmp_path):
    text = one_day(EXAMPLE.read_text())
    assert "6, 10, 3;" in text
    text = text.replace("6, 10, 3;", "6, 10, 3, , , , , 5;")  # in strings of five modules
    shaded = Shaded(text, weather, tmp_path, "--from", "12-20", "--to", "12-21")
    (tmp_path / "report").mkdir()
    shaded.folder.rename(tmp_path / "report" / "modules")
    done = energyplus.run(patched, tmp_path / "model.idf", weather, tmp_path / "run",
                          ["--gpu-shading", f"--gpu-shading-report={tmp_path / 'report'}"])
    assert done.completed, done.why()
    seen = look_at(tmp_path / "report" / "index.html", 1000, LOOK, tmp_path)
    assert seen["troubles"] == [] and seen["faults"] == [] and not seen["hidden"]
    rows = [row for row in shaded.modules if row["surface"] == "ROW 2"]
    assert seen["modules"] == [f"String {row['string']}, column {row['column']}, row {row['row']}: "
                               f"{100 * float(row['beam loss']):.1f} % of its beam is lost" for row in rows]
    assert seen["lost"] == f"{100 * max(float(row['beam loss']) for row in rows):.1f} %"
    assert len(set(seen["fills"])) > 1 and seen["chosen"] == "1"
    for number, titles in (("1", seen["first"]), ("2", seen["second"])):
        hours = {}
        for row in shaded.strings:
            if (row["surface"], row["string"]) == ("ROW 2", number):
                hours.setdefault((int(row["month"]), int(row["day"]), int(row["hour"])), []).append(
                    float(row["sunlit fraction"]))
        shown = {title.rsplit(": ", 1)[0]: float(title.rsplit(": ", 1)[1].split()[0]) for title in titles}
        assert shown.keys() == {f"{day} {MONTHS[month]}, {hour:02}:00" for month, day, hour in hours}
        for (month, day, hour), values in hours.items():
            assert shown[f"{day} {MONTHS[month]}, {hour:02}:00"] == pytest.approx(100 * np.mean(values), abs=0.501)
    assert seen["first"] != seen["second"]


def test_modules_that_cannot_be_read_are_left_out_of_the_page(patched, weather, tmp_path):
    (tmp_path / "model.idf").write_text(one_day(EXAMPLE.read_text()))
    (tmp_path / "report" / "modules").mkdir(parents=True)
    (tmp_path / "report" / "modules" / "modules.json").write_text('{"format": "gpu_shading modules 2"}')
    done = energyplus.run(patched, tmp_path / "model.idf", weather, tmp_path / "run",
                          ["--gpu-shading", f"--gpu-shading-report={tmp_path / 'report'}"])
    assert done.completed, done.why()
    notes = [row["value"] for row in rows_of(tmp_path / "report" / "run_facts.csv") if row["fact"] == "Note"]
    assert notes == ["Modules are left out: modules/modules.json: is of another format"]


def test_files_and_errors(patched, weather, tmp_path):
    text = EXAMPLE.read_text().replace("6, 10, 3;", "6, 10, 3, , , , , , , Yes;")
    shaded = Shaded(text, weather, tmp_path, "--from", "12-21", "--to", "12-21")
    about = json.loads((shaded.folder / "modules.json").read_text())
    assert about["format"] == "gpu_shading modules 1"
    assert [(field["surface"], field["half_cut"]) for field in about["fields"]] == [
        (f"ROW {i}", True) for i in (1, 2, 3)]
    assert set(about["files"]) == {"modules.csv", "strings.csv", "times.csv", *(
        f"ROW_{i}{ending}" for i in (1, 2, 3) for ending in (".npy", ".png", ".svg", "_string_1.png", "_string_1.svg"))}
    (tmp_path / "none.idf").write_text(HALL)
    done = call(tmp_path / "none.idf", "-w", weather, "-o", tmp_path / "none")
    assert done.returncode == 1 and "none.idf: has no GPUShading:PVModules" in done.stderr
    done = call(EXAMPLE, "-o", tmp_path / "none")
    assert done.returncode == 1 and "-w: a weather file is required" in done.stderr


def test_strings_that_end_with_their_surface_are_told(patched, weather, tmp_path):
    """On decks of 20 modules, strings of 8: the last has 4 of each. One of 10 is told nothing."""
    decks = "".join(f"Shading:Building:Detailed,{name},,4, 1,{y + 3.2},5, 1,{y},5, 11,{y},5, 11,{y + 3.2},5;\n"
                    for name, y in (("Deck 1", 1), ("Deck 2", 5), ("Deck 3", 9)))
    for number, told in ((10, None), (20, None), (8, "has 4 of 8 modules"), (50, "has 20 of 50 modules")):
        (tmp_path / "model.idf").write_text(
            HALL + decks + f"GPUShading:PVModules,Modules,Deck *,1,1.6,,6,10,3,0,0,,,{number};\n")
        done = call(tmp_path / "model.idf", "-w", weather, "-o", tmp_path / f"out {number}", "--from", "03-21",
                    "--to", "03-21")
        assert done.returncode == 0, done.stderr
        warnings = [line for line in done.stderr.splitlines() if "string" in line]
        assert warnings == ([] if told is None else [
            f"gpu_shading: warning: {tmp_path / 'model.idf'}: GPUShading:PVModules Modules: strings end with their "
            f"surface: the last one on DECK 1 {told}, and 2 more are short"])
    import gpu_shading

    with pytest.warns(RuntimeWarning, match="strings end with their surface"):
        gpu_shading.modules(tmp_path / "model.idf", weather, first="03-21", last="03-21")
