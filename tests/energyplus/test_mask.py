"""gpu_shading mask: against whole runs of EnergyPlus, closed forms, and readers of its files."""

import csv
import json
import math
import os
import subprocess
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import screened_room
from eso_file import EsoFile
from output_files import rows_of
from PIL import Image
from shading_runs import energyplus, input_file

SUNLIT = "Surface Outside Face Sunlit Fraction"
KINDS = ("building", "shades", "geometry", "trees", "neighbours", "terrain")


def call(*arguments):
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    command = [energyplus.patched_prefix() / "gpu_shading", "mask", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=environment)


def draw(model, folder, *arguments):
    done = call(model, "-o", folder, *arguments)
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"{folder}/masks.csv\n"
    return folder


def test_hours_are_those_of_a_run(patched, courtyard, weather, tmp_path):
    model = input_file.read(courtyard)
    model.remove(lambda name: name in ("runperiod", "shadowcalculation", "output:variable"))
    for month in (3, 6, 12):
        model.add("RunPeriod", [f"Month {month}", month, 21, "", month, 21, "", "Sunday"])
    model.add("ShadowCalculation", ["PixelCounting", "Timestep"])
    model.add_output_variable(SUNLIT, "Timestep")
    model.write(tmp_path / "courtyard.idf")
    run = energyplus.run(patched, tmp_path / "courtyard.idf", weather, tmp_path / "run", ["--gpu-shading"])
    assert run.completed, run.why()
    theirs = EsoFile(run.folder / "eplusout.eso", "TimeStep")
    folder = draw(tmp_path / "courtyard.idf", tmp_path / "masks", "-w", weather, "--step", "10")
    errors, partly = [], 0
    for row in rows_of(folder / "hours.csv"):
        if row["month"] not in ("3", "6", "12") or not row["sunlit fraction"]:
            continue
        value = theirs.values[SUNLIT, row["receiver"]][int(row["month"]), 21, int(row["hour"]), 60]
        errors.append(abs(float(row["sunlit fraction"]) - value))
        partly += 0.02 < value < 0.98
        kinds = sum(float(row[kind]) for kind in KINDS)
        assert float(row["sunlit fraction"]) + kinds == pytest.approx(1.0, abs=0.03)
    print(f"{len(errors)} hours, {partly} partly shaded: largest difference {max(errors):.6f}")
    assert partly > 40 and max(errors) < 0.001


STREET = ("Shading:Site:Detailed,Street,,4, 5000,-9.3,14, 5000,-9.3,-50, -5000,-9.3,-50, -5000,-9.3,14;\n"
          "Shading:Zone:Detailed,Awning,Front,,4, 5000,0,3.2, -5000,0,3.2, -5000,-0.4,3.2, 5000,-0.4,3.2;\n")


@pytest.fixture(scope="module")
def street(tmp_path_factory):
    """(masks of one point of a window with a wall across the street and an awning, that point)"""
    folder = tmp_path_factory.mktemp("street")
    (folder / "room.idf").write_text(screened_room.model(objects=STREET))
    masks = draw(folder / "room.idf", folder / "masks", "--receiver", "Window", "--points", "50")
    [row] = rows_of(masks / "masks.csv")
    return masks, row, [float(row[f"{axis} [m]"]) for axis in "xyz"]


def test_sky_of_a_street_in_closed_form(street):
    masks, row, (_, y, z) = street
    lit = 0
    for cell in rows_of(masks / f"{row['files']}.csv"):
        azimuth, altitude = (math.radians(float(cell[f"{name} [deg]"])) for name in ("azimuth", "altitude"))
        profile = math.tan(altitude) / -math.cos(azimuth)
        wall, awning = profile < (14 - z) / (9.3 + y), profile > (3.2 - z) / (0.4 + y)
        expected = {"sunlit fraction": not wall and not awning, "neighbours": wall, "shades": awning and not wall}
        assert {name: float(cell[name]) for name in expected} == expected, (cell, profile)
        lit += expected["sunlit fraction"]
    assert lit > 300
    view = {name: float(row[name]) for name in ("sky view factor", *KINDS)}
    assert float(row["unshaded view factor"]) == pytest.approx(0.5, abs=1e-6)
    assert sum(view.values()) == pytest.approx(0.5, abs=1e-3)
    # An infinite strip between two profile angles takes half the difference of their sines.
    sines = [math.sin(math.atan(tangent)) for tangent in ((14 - z) / (9.3 + y), (3.2 - z) / (0.4 + y))]
    assert view["neighbours"] == pytest.approx(sines[0] / 2, abs=0.005)
    assert view["shades"] == pytest.approx((1 - sines[1]) / 2, abs=0.005)


def test_horizon_file_is_that_of_the_street(street):
    masks, row, (_, y, z) = street
    # As PVsyst and PV*SOL read it; pvlib's azimuths are clockwise from north.
    azimuths, heights = np.loadtxt(masks / f"{row['files']}.hor").T
    assert (np.diff(azimuths) == 2).all() and azimuths[0] == -179 and azimuths[-1] == 179
    expected = np.degrees(np.arctan((14 - z) / (9.3 + y) * np.maximum(np.cos(np.radians(azimuths)), 0.0)))
    assert np.abs(heights - expected).max() <= 0.02, "not rounded to the step of 2 degrees"
    # pvlib's way to use a horizon: at the sun's azimuth, by interpolation.
    low = [sun for sun in rows_of(masks / "hours.csv") if sun["sunlit fraction"]]
    below = 0
    for sun in low:
        azimuth, altitude = float(sun["sun azimuth [deg]"]), float(sun["sun altitude [deg]"])
        if altitude < np.interp(azimuth, azimuths + 180.0, heights, period=360) - 1.0:
            assert float(sun["sunlit fraction"]) == 0.0
            below += 1
    assert below > 20


def test_hours_are_marked_by_the_chosen_beam(courtyard, weather, tmp_path):
    clear = rows_of(draw(courtyard, tmp_path / "clear", "--step", "10", "--beam", "800") / "hours.csv")
    # ASHRAE's clear sky: A = 1202 W/m2 and B = 0.141 in January.
    for row in clear:
        if row["month"] == "1":
            beam = 1202 * math.exp(-0.141 / math.sin(math.radians(float(row["sun altitude [deg]"]))))
            assert float(row["beam [W/m2]"]) == pytest.approx(beam, abs=0.1)
        assert row["marked"] == ("yes" if float(row["beam [W/m2]"]) >= 800 else "no")
    rows = rows_of(draw(courtyard, tmp_path / "weather", "-w", weather, "--step", "10") / "hours.csv")
    with open(weather, newline="", encoding="utf-8") as file:
        hours = [(int(row[1]), int(row[3]), float(row[14])) for row in list(csv.reader(file))[8:]]
    for month in (1, 4, 7, 10):
        # Between two hours of the file; EnergyPlus interpolates.
        near = [beam for at, hour, beam in hours if at == month and hour in (12, 13)]
        [noon] = {row["beam [W/m2]"] for row in rows if row["month"] == str(month) and row["hour"] == "12"}
        assert float(noon) == pytest.approx(sum(near) / len(near), rel=0.1)
    assert json.loads((tmp_path / "weather" / "masks.json").read_text())["marked"].endswith("EPW)")


def test_trees_are_a_kind(tmp_path):
    tree = "GPUShading:Tree,Linden,3,-6,0,9,4,1;\n"
    (tmp_path / "room.idf").write_text(screened_room.model(objects=tree))
    folder = draw(tmp_path / "room.idf", tmp_path / "masks", "--receiver", "Window", "--step", "5")
    [row] = rows_of(folder / "masks.csv")
    assert 0.005 < float(row["trees"]) < 0.2
    assert sum(float(row[kind]) for kind in KINDS if kind != "trees") < 0.001
    south = [hour for hour in rows_of(folder / "hours.csv") if hour["month"] == "12" and hour["hour"] == "12"]
    assert float(south[0]["trees"]) > 0.05


CURTAIN = ("Schedule:Compact,Season,,Through: 6/30,For: AllDays,Until: 24:00,0.25,"
           "Through: 12/31,For: AllDays,Until: 24:00,0.75;\n"
           "Shading:Site:Detailed,Curtain,Season,4, 500,-1,500, 500,-1,-50, -500,-1,-50, -500,-1,500;\n")


@pytest.fixture(scope="module")
def curtain(weather, tmp_path_factory):
    """(a window behind a curtain that is thin from July on, a folder of its samples)"""
    folder = tmp_path_factory.mktemp("curtain")
    (folder / "room.idf").write_text(screened_room.model(objects=CURTAIN))
    command = [energyplus.patched_prefix() / "gpu_shading", "sample", folder / "room.idf", "-w", weather, "-o",
               folder / "samples", "--mode", "coarse"]
    subprocess.run(command, capture_output=True, check=True)
    return folder / "room.idf", folder / "samples"


def test_hours_of_samples_have_schedules(curtain, weather, tmp_path):
    model, samples = curtain
    folder = draw(model, tmp_path / "masks", "-w", weather, "--receiver", "Window", "--step", "10", "--samples",
                  samples)
    rows = [row for row in rows_of(folder / "hours.csv") if row["sunlit fraction"]]
    assert len(rows) > 80
    for row in rows:
        assert float(row["sunlit fraction"]) == pytest.approx(0.25 if int(row["month"]) <= 6 else 0.75, abs=2e-3)
        assert float(row["sunlit fraction"]) + float(row["neighbours"]) == pytest.approx(1.0, abs=1e-3)


def test_samples_of_another_model_are_refused(curtain, courtyard, weather, tmp_path):
    model, samples = curtain
    done = call(courtyard, "-w", weather, "-o", tmp_path / "a", "--samples", samples, "--step", "10")
    assert "year.csv: has no receiver WEST COURT BACK WINDOW: of another model?" in done.stderr
    moved = input_file.read(model)
    moved.remove(lambda name: name == "site:location")
    moved.add("Site:Location", ["Quito", -0.2, -78.5, -5, 2800])
    moved.write(tmp_path / "moved.idf")
    done = call(tmp_path / "moved.idf", "-o", tmp_path / "b", "--samples", samples, "--step", "10")
    assert done.returncode == 1 and "of another site?" in done.stderr
    done = call(model, "-o", tmp_path / "c", "--samples", tmp_path)
    assert f"{tmp_path / 'year.csv'}" in done.stderr
    assert not (tmp_path / "c").exists()


@pytest.mark.parametrize("projection", ["stereographic", "equidistant", "cylindrical"])
def test_pictures(courtyard, tmp_path, projection):
    folder = draw(courtyard, tmp_path / "masks", "--receiver", "West Court*Window", "--projection", projection)
    rows = rows_of(folder / "masks.csv")
    assert [row["files"] for row in rows] == ["WEST_COURT_BACK_WINDOW", "WEST_COURT_SIDE_WINDOW"]
    for row in rows:
        texts = [text.text for text in ET.parse(folder / f"{row['files']}.svg").iter("{http://www.w3.org/2000/svg}text")]
        assert row["receiver"] in texts
        assert f"Sky view factor {float(row['sky view factor']):.3f}, unshaded 0.500" in texts
        for kind, words in (("building", "The building itself"), ("shades", "Shades")):
            share = float(row[kind]) / 0.5
            assert any(text.startswith(f"{words}: hides {100 * share:.0f}"[:-1]) for text in texts)
        assert not any(text.startswith("Terrain") for text in texts)
        with Image.open(folder / f"{row['files']}.png") as picture:
            assert len(picture.convert("RGB").getcolors(1 << 24)) > 100
        print(folder / f"{row['files']}.png")


@pytest.mark.parametrize("arguments, why", [
    (["--receiver", "West Curt Back Window"], "did you mean WEST COURT BACK WINDOW?"),
    (["--step", "4"], "--step: 4 not in {1,2,3,5,6,9,10}"),
    (["--points", "0.001"], "--points 0.001: a receiver of 2 m x 2 m has more than 1000000 cells"),
    (["--points", "0.01"], "use a larger step or spacing"),
])
def test_errors_say_what_was_expected(courtyard, tmp_path, arguments, why):
    done = call(courtyard, "-o", tmp_path / "masks", *arguments)
    assert done.returncode == 1
    assert why in done.stderr
    assert not list((tmp_path / "masks").glob("*.csv"))
