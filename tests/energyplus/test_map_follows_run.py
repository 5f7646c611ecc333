"""The beam of `gpu_shading map` and `modules` is that of a run, whatever moves or follows a schedule."""

import re
import shutil
import subprocess

import numpy as np
import pytest
from output_files import rows_of
from shading_runs import energyplus
from test_map import INCIDENT, beams_of, draw, energies_of, of_period
from test_modules import DECK, HALL, Shaded
from test_moving import AWNING, FULL, by_the_hour, moving, of_hours, room, surface
from test_run_page import content_of

TREES = energyplus.REPOSITORY / "idf_examples" / "trees"
MONTHS_OF_LIGHT = 7  # of a receiver on the page: those of the beam are first


def beam_of_run(patched, path, weather, folder):
    run = energyplus.run(patched, path, weather, folder, ["--gpu-shading"])
    assert run.completed, run.why() + run.text("eplusout.err")
    return beams_of(run)["WINDOW"]


def beam_of_map(path, weather, folder, begin, end, *options):
    days = [f"--{option}={month:02}-{day:02}" for option, (month, day) in (("from", begin), ("to", end))]
    return energies_of(draw(path, weather, folder, *days, "--rays", "16", "--receivers", "Window", *options))["WINDOW"]


# Leaves come on April 7, and fall after October 27.
@pytest.mark.parametrize("begin, end", [((10, 26), (10, 29)), ((4, 5), (4, 8))])
def test_deciduous_trees_without_a_schedule_are_in_leaf_in_their_season(patched, official, weather, tmp_path, begin,
                                                                        end):
    path = tmp_path / "trees.idf"
    shutil.copy(TREES / "trees.geojson", tmp_path)
    of_period(TREES / "trees.idf", begin, end).write(path)
    of_run = beam_of_run(patched, path, weather, tmp_path / "run")
    assert beam_of_map(path, weather, tmp_path / "maps", begin, end) == pytest.approx(of_run, rel=0.01)
    # In epJSON, with the trees in a side file.
    trees = re.compile(r"GPUShading:[^;]*;\s*")
    path.write_text(trees.sub("", text := path.read_text()))
    subprocess.run([official, "--convert-only", "-d", tmp_path, path], check=True, capture_output=True)
    (tmp_path / "trees.gpu-shading.idf").write_text("".join(trees.findall(text)))
    converted = next(tmp_path.glob("*.epJSON"))
    assert beam_of_map(converted, weather, tmp_path / "again", begin, end) == pytest.approx(of_run, rel=0.01)


def test_october_behind_the_example_trees(weather, tmp_path):
    beam = beam_of_map(TREES / "trees.idf", weather, tmp_path / "maps", (10, 1), (10, 31), "--spacing", "0.25")
    assert beam == pytest.approx(54.54, rel=0.01)


def test_exported_fractions_know_the_season(weather, tmp_path):
    command = [energyplus.patched_prefix() / "gpu_shading", "export", TREES / "trees.idf", "-w", weather,
               "--scheduled", tmp_path / "out"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    table = rows_of(tmp_path / "out" / "gpu_shading_sunlit.csv")
    # October 21 of a leap year, 8:30 to 8:45; 0.329 without leaves.
    row = table[4 * 24 * (31 + 29 + 31 + 30 + 31 + 30 + 31 + 31 + 30 + 20) + 34]
    assert float(row["WINDOW"]) == pytest.approx(0.0065, abs=2e-4)


MOVING = {
    "an awning by schedule, between coarse steps": (
        surface("Awning", AWNING), moving("Awning", "Extend", dy=-1, step=0.5, schedule="Position"),
        by_the_hour(lambda hour: f"{hour * 0.17 % 1:.2f}")),
    "slats that block the beam": (
        FULL, moving("Slat *", "Rotate", step=5, control="BlockBeam", receiver="Window", maximum=30, hysteresis=10)),
    "slats in little wind and strong sun": (
        FULL, moving("Slat *", "Rotate", control="TrackSun", receiver="Window", beam=200, wind=4, minimum=-90)),
    "slats that face the sun": (
        FULL, moving("Slat *", "Rotate", step=1, control="TrackSun", minimum=-90, maximum=90, rest=0)),
    "slats that work in the afternoon": (
        FULL, moving("Slat *", "Rotate", control="TrackSun", available="Position"), of_hours((12, 0), (24, 1)))}


@pytest.mark.parametrize("case", MOVING)
def test_a_map_follows_moving_shades(patched, weather, tmp_path, case):
    path = tmp_path / "model.idf"
    path.write_text(room(*MOVING[case]))
    model = of_period(path, (3, 20), (3, 23))
    model.remove(lambda name: name in ("simulationcontrol", "timestep"))
    model.add("SimulationControl", ["No", "No", "No", "No", "Yes"])
    model.add("Timestep", [4])
    model.write(path)
    of_run = beam_of_run(patched, path, weather, tmp_path / "run")
    found = beam_of_map(path, weather, tmp_path / "maps", (3, 20), (3, 23))
    resting = beam_of_map(path, weather, tmp_path / "rest", (3, 20), (3, 23), "--gpu-shading-positions", "Shade=0")
    assert found == pytest.approx(of_run, rel=0.01)
    assert abs(resting / of_run - 1.0) > 0.05, "the motion has no effect"


def test_the_two_beams_of_a_page_are_one(patched, weather, tmp_path):
    """A year behind a tree, glass on a schedule, and an awning that moves."""
    text = room(surface("Awning", AWNING), moving("Awning", "Extend", dy=-1, step=0.25, schedule="Position"),
                by_the_hour(lambda hour: f"{hour * 0.17 % 1:.2f}"),
                surface("Pane", [(-20, -0.9, 3), (-20, -0.9, 0), (20, -0.9, 0), (20, -0.9, 3)]).replace(
                    "Pane,,", "Pane,Cleaning,"),
                "Schedule:Compact,Cleaning,,Through: 6/30,For: AllDays,Until: 24:00,0.5,"
                "Through: 12/31,For: AllDays,Until: 24:00,0.9;\n",
                "GPUShading:Tree,Oak,1,-5,0,8,5,2,Ellipsoid,0,Deciduous,,0.6,0.1;\n")
    path = tmp_path / "model.idf"
    path.write_text(text.replace("Timestep,6;", "Timestep,1;").replace("No,No,No,Yes,No;", "No,No,No,No,Yes;")
                    + f"RunPeriod,Year,1,1,,12,31,,Sunday;\nOutput:Variable,Window,{INCIDENT},Timestep;\n")
    run = energyplus.run(patched, path, weather, tmp_path / "out",
                         ["--gpu-shading", f"--gpu-shading-report={tmp_path / 'report'}", "--gpu-shading-maps"])
    assert run.completed, run.why()
    content = content_of(tmp_path / "report" / "index.html")
    receiver = content["receivers"][content["names"].index("WINDOW")]
    of_run = sum(receiver[MONTHS_OF_LIGHT][0])
    of_map = energies_of(tmp_path / "report" / "maps")["WINDOW"]
    assert of_map == pytest.approx(beams_of(run, 1)["WINDOW"], rel=0.005)
    # The page multiplies hourly weather and fractions, and rounds months to 0.1.
    assert of_run == pytest.approx(of_map, rel=0.015)
    assert of_run > 100.0


def test_modules_follow_moving_shades(weather, tmp_path):
    """As in models in which the pole, and then the deck with its modules, stand there."""
    def pole(east):
        return (f"Shading:Building:Detailed,Pole,,4, {5 + east},0.7,7.2, {5 + east},0.7,5, {5.2 + east},0.7,5, "
                f"{5.2 + east},0.7,7.2;\n")

    def shaded(name, *parts):
        (tmp_path / name).mkdir()
        return Shaded("".join(parts), weather, tmp_path / name, "--from", "03-21", "--to", "03-21")

    def slide(pattern, direction):
        return f"GPUShading:MovingShade,Shade,{pattern},Slide,,{direction},,,,,2,0.5,,Schedule,Position;\n"

    schedule = of_hours((12, 0), (24, 1.4))  # 1.5 is the nearest
    still, east = shaded("still", HALL, DECK, pole(0)), shaded("east", HALL, DECK, pole(1.5))
    north = shaded("north", HALL, DECK.replace("4.2,5", "5.7,5").replace(",1,5", ",2.5,5"), pole(0))
    after = np.array([int(row["hour"]) > 12 for row in still.times])
    for name, moves, there in (("pole", slide("Pole", "1,0,0"), east), ("deck", slide("Deck", "0,1,0"), north)):
        found = shaded(name, HALL, DECK, pole(0), moves, schedule).cells("DECK")
        assert found[~after] == pytest.approx(still.cells("DECK")[~after], abs=1e-4)
        assert found[after] == pytest.approx(there.cells("DECK")[after], abs=1e-4)
        assert np.abs(there.cells("DECK")[after] - still.cells("DECK")[after]).max() > 0.5


@pytest.mark.parametrize("command", ["map", "modules"])
def test_a_schedule_that_only_another_program_has_is_named(weather, tmp_path, command):
    path = tmp_path / "model.idf"
    path.write_text(HALL + DECK + "ScheduleTypeLimits,Any;\nExternalInterface,FunctionalMockupUnitExport;\n"
                    "ExternalInterface:FunctionalMockupUnitExport:To:Schedule,Glass,Any,glass,0.5;\n"
                    "Shading:Building:Detailed,Pane,Glass,4, 1,0,7, 1,0,5, 2,0,5, 2,0,7;\n")
    done = subprocess.run([energyplus.patched_prefix() / "gpu_shading", command, path, "-o", tmp_path / "out", "-w",
                           weather], capture_output=True, text=True)
    assert done.returncode != 0
    lines = [line for line in done.stderr.splitlines() if "error" in line]
    assert len(lines) == 1, done.stderr
    assert "PANE: Transmittance Schedule Name: " in lines[0]
    assert 'has none called "GLASS"' in lines[0]
