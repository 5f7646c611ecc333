"""GPUShading:MovingShade against models in which the shades stand there, and against closed forms."""

import base64
import csv
import json
import math
import re
import shutil
import sqlite3
import subprocess
from pathlib import Path

import numpy as np
import pytest
import window_with_shades
from html_page import SOFTWARE_WEBGL, look_at
from PIL import Image
from shading_runs import energyplus
from test_run_page import content_of

FRACTION = "Surface Outside Face Sunlit Fraction"
SAME = 1e-6  # of a sunlit fraction: EnergyPlus hands over vertices in single precision
FAR = window_with_shades.FAR
LOW, HIGH = 1.0, 1.0 + window_with_shades.SIZE
DAYS = ("Output:Variable,*,Schedule Value,Timestep;\n")

# A slat of 0.2 m in front of the window, an awning over it, and a panel beside it.
SLATS = [[(-FAR, -0.3, z), (-FAR, -0.5, z), (FAR, -0.5, z), (FAR, -0.3, z)] for z in (1.3, 1.5, 1.7, 1.9)]
AWNING = [(-FAR, 0, HIGH), (-FAR, -1.2, HIGH), (FAR, -1.2, HIGH), (FAR, 0, HIGH)]
PANEL = [(1, -0.2, 3.5), (1, -0.2, 1.2), (2, -0.2, 1.2), (2, -0.2, 3.5)]


def surface(name, points):
    return (f"Shading:Building:Detailed,{name},,{len(points)},\n"
            + ",\n".join(f"  {x:.12f},{y:.12f},{z:.12f}" for x, y, z in points) + ";\n")


def room(*parts, detailed=False):
    text = window_with_shades.model("south", False, False)
    if detailed:
        text = text.replace("PolygonClipping,Timestep;", "PolygonClipping,Timestep,,,,,DetailedSkyDiffuseModeling;")
    return text + "".join(parts)


def slats(turn=0.0):
    """The slats turned about their centre lines, which point east."""
    sine, cosine = math.sin(math.radians(turn)), math.cos(math.radians(turn))
    parts = []
    for number, points in enumerate(SLATS):
        _, cy, cz = (sum(p[i] for p in points) / 4 for i in range(3))
        turned = [(x, cy + cosine * (y - cy) - sine * (z - cz), cz + sine * (y - cy) + cosine * (z - cz))
                  for x, y, z in points]
        parts.append(surface(f"Slat {number}", turned))
    return "".join(parts)


def moving(pattern, motion, **fields):
    names = ["axis", "dx", "dy", "dz", "px", "py", "pz", "minimum", "maximum", "step", "rest", "control", "schedule",
             "receiver", "available", "beam", "hysteresis", "wind"]
    assert not set(fields) - set(names)
    return (f"GPUShading:MovingShade,Shade,{pattern},{motion},"
            + ",".join(str(fields.get(name, "")) for name in names) + ";\n")


@pytest.fixture
def run(patched, weather, tmp_path):
    def call(text, *options, name="model", year=False):
        path = tmp_path / f"{name}.idf"
        path.write_text(text)
        days = [] if year else ["-D"]
        done = energyplus.run(patched, path, weather, tmp_path / name, ["--gpu-shading", *days, *options])
        assert done.completed, done.why() + done.errors + done.text("eplusout.err")
        return done

    return call


def series(done, variable, key="WINDOW"):
    """{time: value} of a variable of the run."""
    with sqlite3.connect(f"file:{done.folder / 'eplusout.sql'}?mode=ro", uri=True) as data:
        rows = data.execute(
            "SELECT TimeIndex, Value FROM ReportData JOIN ReportDataDictionary USING (ReportDataDictionaryIndex) "
            "WHERE Name = ? AND upper(KeyValue) LIKE ?", (variable, key))
        return dict(rows.fetchall())


def assert_same(one, other, most=SAME):
    first, second = series(one, FRACTION), series(other, FRACTION)
    assert first.keys() == second.keys()
    assert len(set(first.values())) > 10, "the shade has no effect"
    assert max(abs(first[time] - second[time]) for time in first) <= most


def constant(value):
    return f"Schedule:Constant,Position,,{value};\n"


def of_hours(*ends):
    """A schedule of (hour, position) for every day, each until the hour."""
    parts = ",".join(f"Until: {hour}:00,{position}" for hour, position in ends)
    return f"Schedule:Compact,Position,,Through: 12/31,For: AllDays,{parts};\n"


def by_the_hour(position):
    """of_hours() of position(hour) for hours 1 to 23, and 0 for the last."""
    return of_hours(*((hour, position(hour)) for hour in range(1, 24)), (24, 0))


def moved(points, move):
    return [move(*point) for point in points]


CASES = {
    "centre line": (slats(), moving("Slat *", "Rotate", schedule="Position"), 35, slats(35)),
    "edge": (surface("Awning", AWNING),
             moving("Awning", "Rotate", axis="Edge", dx=0, dy=1, minimum=-60, maximum=0, schedule="Position"), -30,
             surface("Awning", moved(AWNING, lambda x, y, z: (x, y * math.cos(math.pi / 6),
                                                              HIGH - y * math.sin(math.pi / 6))))),
    "given axis": (surface("Panel", PANEL),
                   moving("Panel", "Rotate", axis="Given", dx=0, dy=0, dz=2, px=1, py=-0.2, pz=0, minimum=-90,
                          maximum=0, schedule="Position"), -60,
                   surface("Panel", moved(PANEL, lambda x, y, z: (1 + (x - 1) / 2, -0.2 - (x - 1) * math.sqrt(3) / 2,
                                                                  z)))),
    "slide": (surface("Panel", PANEL), moving("Panel", "Slide", dx=-5, dy=0, dz=0, maximum=3, schedule="Position"), 1.5,
              surface("Panel", moved(PANEL, lambda x, y, z: (x - 1.5, y, z)))),
    "extend": (surface("Awning", AWNING), moving("Awning", "Extend", dx=0, dy=-1, dz=0, schedule="Position"), 0.4,
               surface("Awning", moved(AWNING, lambda x, y, z: (x, 0.4 * y, z)))),
}


@pytest.mark.parametrize("name", CASES)
def test_a_position_equals_the_model_in_which_the_surfaces_stand_there(run, name):
    drawn, shade, position, there = CASES[name]
    assert_same(run(room(drawn, shade, constant(position))), run(room(there), name="there"))


def test_translucent_and_perforated_slats_move_too(run):
    fabric = ("GPUShading:TransparentShade,Fabric,Slat 0,Constant,0.3;\n"
              "GPUShading:PerforatedScreen,Mesh,Slat 1,Round,,Straight,0.005,,0.01,,0.001;\n")
    assert_same(run(room(slats(), fabric, CASES["centre line"][1], constant(35))),
                run(room(slats(35), fabric), name="there"))


def sun(done):
    azimuth = series(done, "Site Solar Azimuth Angle", "%")
    altitude = series(done, "Site Solar Altitude Angle", "%")
    return {time: (azimuth[time], altitude[time]) for time in azimuth}


def suns_before_the_window(done):
    """(time, angle in radians from the south to the west, altitude in degrees) where the sun lights a south window."""
    for time, (azimuth, altitude) in sun(done).items():
        g = math.radians(azimuth - 180.0)
        if altitude > 2.0 and math.cos(g) > 0.05:
            yield time, g, altitude


def test_an_awning_extends_as_its_closed_form_says(run):
    schedule = by_the_hour(lambda hour: hour % 5 * 0.25)
    done = run(room(surface("Awning", AWNING), moving("Awning", "Extend", dy=-1, schedule="Position"), schedule, DAYS))
    fractions, shares = series(done, FRACTION), series(done, "Schedule Value", "POSITION")
    compared = 0
    for time, g, altitude in suns_before_the_window(done):
        drop = 1.2 * shares[time] * math.tan(math.radians(altitude)) / math.cos(g)
        assert abs(fractions[time] - max(0.0, 1.0 - drop / window_with_shades.SIZE)) < 2e-4
        compared += shares[time] > 0.0
    assert compared > 20


# Four panels of 0.75 m before the window, far higher and lower than it, from its west side to its east side.
PANEL_WIDTH, TRACK = 0.75, 0.1
PANELS = "".join(surface(f"Panel {i}", [(x, -TRACK, 40), (x, -TRACK, -40), (x + PANEL_WIDTH, -TRACK, -40),
                                        (x + PANEL_WIDTH, -TRACK, 40)])
                 for i, x in enumerate(-window_with_shades.SIZE / 2 + PANEL_WIDTH * i for i in range(4)))


def folded_cover(turn, run_east):
    """The share of the window's width behind panels folded by an angle; `run_east`: per metre that light moves inwards.

    Panels are connected, so that their shadow reaches from the first to the last of the shadows of their hinges.
    """
    hinges = [(-window_with_shades.SIZE / 2 + PANEL_WIDTH * i * math.cos(turn),
               TRACK + (PANEL_WIDTH * math.sin(turn) if i % 2 else 0.0)) for i in range(5)]
    shadows = [x + out * run_east for x, out in hinges]
    half = window_with_shades.SIZE / 2
    return max(0.0, min(max(shadows), half) - max(min(shadows), -half)) / window_with_shades.SIZE


def test_panels_fold_as_their_closed_form_says(run):
    schedule = by_the_hour(lambda hour: hour * 25 % 100)
    shade = moving("Panel *", "Fold", dx=1, schedule="Position", step=0.5)
    done = run(room(PANELS, shade, schedule, DAYS))
    fractions, turns = series(done, FRACTION), series(done, "Schedule Value", "POSITION")
    compared = set()
    for time, g, _ in suns_before_the_window(done):
        # From the south-west, light moves to the east.
        cover = folded_cover(math.radians(min(turns[time], 90.0)), math.tan(g))
        assert abs(fractions[time] - (1.0 - cover)) < 2e-4, (time, turns[time], g)
        compared.add(turns[time])
    assert len(compared) >= 4


REPORT = ("--gpu-shading-report", "report")


def rows(done):
    """Those of positions.csv."""
    with open(done.folder / "report" / "positions.csv", newline="") as table:
        return list(csv.DictReader(table))


def positions(done):
    """[(azimuth, altitude, position)] of the timesteps, in order."""
    suns, table = sun(done), rows(done)
    return [(*suns[time], float(row["Shade position [deg]"])) for time, row in zip(sorted(suns), table, strict=True)]


WIDTH, PITCH = 0.2, 0.2
FULL = "".join(surface(f"Slat {i}", [(-FAR, -0.3, z), (-FAR, -0.5, z), (FAR, -0.5, z), (FAR, -0.3, z)])
               for i, z in enumerate(LOW - 0.05 + PITCH * i for i in range(40)))


def cut_off(profile):
    """The smallest turn, in degrees, of slats as wide as their pitch that lets no beam pass at a profile angle.

    A slat turned by t reaches W cos(t) out and drops W sin(t): its shadow on the plane of the slats is
    W (sin t + cos t tan(profile)) high, which is a pitch at least.
    """
    for tenth in range(901):
        turn = math.radians(tenth / 10)
        if WIDTH * (math.sin(turn) + math.cos(turn) * math.tan(profile)) >= PITCH - 1e-9:
            return tenth / 10
    return 90.0


@pytest.mark.parametrize("device", ["cpu", "0"])
def test_block_beam_turns_slats_to_the_cut_off_angle(run, device):
    shade = moving("Slat *", "Rotate", step=1, control="BlockBeam", receiver="Window", maximum=90)
    winter = room(FULL, shade).replace("21 August,8,21,", "21 December,12,21,")
    done = run(winter, f"--gpu-shading-device={device}", *REPORT)
    fractions = series(done, FRACTION)
    lit = [fractions[time] for time in sorted(fractions)]
    compared = 0
    for (azimuth, altitude, position), fraction in zip(positions(done), lit, strict=True):
        g = math.radians(azimuth - 180.0)
        if altitude <= 1.0 or math.cos(g) <= 0.05:
            continue
        assert fraction <= 1e-6
        exact = cut_off(math.atan2(math.tan(math.radians(altitude)), math.cos(g)))
        assert exact - 0.1 <= position <= math.ceil(exact), (azimuth, altitude, exact)
        compared += 1
    assert compared > 20
    assert {row["Shade state"] for row in rows(done)} >= {"at rest", "blocking"}


def test_wind_keeps_shades_at_rest(run):
    """The design day's wind is 3 m/s."""
    control = CASES["centre line"][1].rstrip(";\n")
    assert control.endswith(",")  # Hysteresis is blank.
    calm = run(room(slats(), control + "3.1;\n", constant(35)), *REPORT)
    windy = run(room(slats(), control + "2.9;\n", constant(35)), *REPORT, name="windy")
    assert {(row["Shade position [deg]"], row["Shade state"]) for row in rows(calm)} == {("35", "scheduled")}
    assert {(row["Shade position [deg]"], row["Shade state"]) for row in rows(windy)} == {("0", "windy")}
    assert_same(windy, run(room(slats()), name="level"))


def test_position_and_state_are_output_variables(run):
    outputs = "".join(f"Output:Variable,*,GPU Shading Moving Shade {name},Timestep;\n"
                      for name in ("Position", "Control State"))
    shade = moving("Slat *", "Rotate", step=1, control="BlockBeam", receiver="Window", maximum=90)
    done = run(room(FULL, shade, outputs).replace("21 August,8,21,", "21 December,12,21,"), *REPORT)
    table = rows(done)
    position = series(done, "GPU Shading Moving Shade Position", "SHADE")
    state = series(done, "GPU Shading Moving Shade Control State", "SHADE")
    assert [position[time] for time in sorted(position)] == [float(row["Shade position [deg]"]) for row in table]
    states = ["at rest", "scheduled", "clear", "blocking", "admitting", "tracking", "held", "windy"]
    assert [states[round(state[time])] for time in sorted(state)] == [row["Shade state"] for row in table]
    assert len(set(position.values())) > 5
    assert len(set(state.values())) >= 2
    assert "GPU Shading Moving Shade Position [deg]" in done.text("eplusout.eso")


def test_between_steps_fractions_are_interpolated(run):
    """The shadow of an awning is as long as the awning: interpolated between rolled up and extended, it is exact."""
    schedule = by_the_hour(lambda hour: f"{hour * 0.17 % 1:.2f}")
    shade = moving("Awning", "Extend", dy=-1, step=1, schedule="Position")
    done = run(room(surface("Awning", AWNING), shade, schedule, DAYS).replace("21 August,8,21,", "21 December,12,21,"))
    fractions, shares = series(done, FRACTION), series(done, "Schedule Value", "POSITION")
    compared = set()
    for time, g, altitude in suns_before_the_window(done):
        drop = 1.2 * math.tan(math.radians(altitude)) / math.cos(g)
        assert drop < window_with_shades.SIZE
        assert abs(fractions[time] - (1.0 - shares[time] * drop / window_with_shades.SIZE)) < 2e-4
        compared.add(shares[time])
    assert len(compared) > 7


def test_the_error_of_the_step_is_stated(run):
    schedule = by_the_hour(lambda hour: f"{7.3 * hour % 45:.2f}")
    fractions, statements = {}, {}
    for step in (20, 5, 0.01):
        done = run(room(slats(), moving("Slat *", "Rotate", step=step, schedule="Position"), schedule),
                   name=f"step {step}")
        fractions[step], statements[step] = series(done, FRACTION), done.text("eplusout.err")
    up = [time for time, (_, altitude) in sun(done).items() if altitude > 0.0]
    means = []
    for step in (20, 5):
        errors = [abs(fractions[step][time] - fractions[0.01][time]) for time in up]
        found = re.search(r"most affected by about (\S+) on average, (\S+) at most", statements[step])
        mean, most = map(float, found.groups())
        # The window is not always the surface most affected; in the shade, nothing is.
        assert sum(errors) / len(errors) <= mean * 1.2
        assert max(errors) * 0.5 <= most <= max(errors) * 3.0
        means.append(sum(errors) / len(errors))
    # It falls with the square of the step, while rounding would change the fraction by some per cent.
    assert means[1] < means[0] / 4.0 and means[0] < 1e-3
    assert "most affected" not in statements[0.01]  # All are on its grid.


def test_track_sun_faces_the_profile_angle(run):
    shade = moving("Slat *", "Rotate", step=1, control="TrackSun", minimum=-90, maximum=90, rest=0)
    done = run(room(FULL, shade), *REPORT)
    for azimuth, altitude, position in positions(done):
        g = math.radians(azimuth - 180.0)
        if altitude <= 1.0 or abs(math.cos(g)) <= 0.05:
            continue
        profile = math.degrees(math.atan2(math.tan(math.radians(altitude)), math.cos(g)))
        # The normal of a slat that is turned by t rises by 90 - t.
        assert abs(position - (90.0 - profile)) <= 0.51, (azimuth, altitude)


@pytest.fixture
def with_plugins(patched, official, tmp_path):
    """A patched EnergyPlus that can run Python plugins: that of PyPI lacks their standard library and pyenergyplus."""
    api = energyplus.REPOSITORY / ".venv" / "EnergyPlus-lbnl" / "pyenergyplus"
    if not api.is_dir():
        pytest.skip(f"{api} is missing: scripts/setup could not fetch pyenergyplus-lbnl")
    stdlib = "import sys, sysconfig; print(sysconfig.get_path('stdlib'), sys.version_info[:2] == (3, 12))"
    pyenv = sorted((Path.home() / ".pyenv" / "versions").glob("3.12*/bin/python3.12"))
    for python in filter(None, [shutil.which("python3.12"), *pyenv]):
        found = subprocess.run([python, "-c", stdlib], capture_output=True, text=True, check=False).stdout.split()
        if found[1:] == ["True"]:
            break
    else:
        pytest.skip("Python 3.12, whose standard library EnergyPlus's plugins need, is not installed")
    source = tmp_path / "EnergyPlus"
    source.mkdir()
    for path in official.parent.resolve().iterdir():
        (source / path.name).symlink_to(path)
    (source / "python_lib").symlink_to(found[0])
    (source / "pyenergyplus").symlink_to(api)
    program = energyplus.REPOSITORY / "scripts" / "patch_energyplus"
    subprocess.run([program, source, tmp_path / "patched"], check=True, capture_output=True)
    return tmp_path / "patched" / "energyplus"


PLUGIN = """
from pyenergyplus.plugin import EnergyPlusPlugin

class Turn(EnergyPlusPlugin):
    def on_begin_zone_timestep_before_init_heat_balance(self, state):
        exchange = self.api.exchange
        angle = exchange.get_actuator_handle(state, "Schedule:Compact", "Schedule Value", "Position")
        hour = exchange.hour(state)
        exchange.set_actuator_value(state, angle, (hour + 1) * 7 % 60 if hour < 23 else 0)
        return 0
"""
STEPS = by_the_hour(lambda hour: hour * 7 % 60)
RESTING = of_hours((24, 0))


def ems(schedule="Schedule:Compact"):
    program = "EnergyManagementSystem:Program,Turn"
    for hour in range(24):
        program += f",\n  IF Hour == {hour},SET Angle = {(hour + 1) * 7 % 60 if hour < 23 else 0},ENDIF"
    return (f"EnergyManagementSystem:Actuator,Angle,Position,{schedule},Schedule Value;\n"
            + "EnergyManagementSystem:ProgramCallingManager,Caller,BeginZoneTimestepBeforeInitHeatBalance,Turn;\n"
            + program + ";\n")


def assert_moves_as_scheduled(scheduled, overridden):
    one, two = ([row["Shade position [deg]"] for row in rows(each)] for each in (scheduled, overridden))
    assert len(set(one)) > 10
    assert two == one
    assert_same(scheduled, overridden)


def test_an_ems_that_overrides_the_schedule_moves_the_shade_as_the_schedule_would(run):
    shade = CASES["centre line"][1]
    scheduled = run(room(slats(), shade, STEPS, DAYS), *REPORT)
    assert_moves_as_scheduled(scheduled, run(room(slats(), shade, RESTING, ems(), DAYS), *REPORT, name="ems"))
    constant_one = room(slats(), shade, constant(0), ems("Schedule:Constant"), DAYS)
    assert_moves_as_scheduled(scheduled, run(constant_one, *REPORT, name="constant"))


def test_a_python_plugin_that_overrides_the_schedule_moves_the_shade_as_the_schedule_would(
        run, with_plugins, weather, tmp_path):
    shade = CASES["centre line"][1]
    path = tmp_path / "plugin.idf"
    path.write_text(room(slats(), shade, RESTING, "PythonPlugin:Instance,Turner,Yes,turn,Turn;\n"
                         "PythonPlugin:SearchPaths,Paths,Yes,Yes,No;\n", DAYS))
    (tmp_path / "turn.py").write_text(PLUGIN)
    plugin = energyplus.run(with_plugins, path, weather, tmp_path / "plugin", ["--gpu-shading", "-D", *REPORT])
    assert plugin.completed, plugin.why() + plugin.errors + plugin.text("eplusout.err")
    assert_moves_as_scheduled(run(room(slats(), shade, STEPS, DAYS), *REPORT), plugin)


TO_NAN = PLUGIN.replace("(hour + 1) * 7 % 60 if hour < 23 else 0", 'float("nan") if hour == 12 else 20')
LEAVES = "Schedule:Compact,Leaves,,Through: 12/31,For: AllDays,Until: 24:00,0.5;\n"


@pytest.mark.parametrize("parts, named", [
    ((slats(), CASES["centre line"][1], RESTING),
     "GPUShading:MovingShade Shade: Position Schedule Name: schedule \"POSITION\""),
    ((slats().replace("Slat 0,,", "Slat 0,Position,"), LEAVES, RESTING),
     "SLAT 0: Transmittance Schedule Name: schedule \"POSITION\"")], ids=["position", "transmittance"])
def test_a_schedule_that_a_plugin_sets_to_nan_stops_the_run(with_plugins, weather, tmp_path, parts, named):
    path = tmp_path / "plugin.idf"
    path.write_text(room(*parts, "PythonPlugin:Instance,Turner,Yes,turn,Turn;\n"
                         "PythonPlugin:SearchPaths,Paths,Yes,Yes,No;\n"))
    (tmp_path / "turn.py").write_text(TO_NAN)
    done = energyplus.run(with_plugins, path, weather, tmp_path / "out", ["--gpu-shading", "-D"])
    assert not done.completed
    lines = [line for line in done.text("eplusout.err").splitlines() if named in line]
    assert len(lines) == 1, done.text("eplusout.err")
    assert "08-21, hour 13, timestep 1: " in lines[0]
    assert "has the value nan; expected a finite number" in lines[0]


def test_a_cache_keeps_positions_apart(run, tmp_path):
    cache = ("--gpu-shading-cache", str(tmp_path / "cache"))
    shade = CASES["centre line"][1]
    one, other = (room(slats(), shade, constant(position)) for position in (35, 10))
    run(one, *cache)
    second = run(other, *cache, name="other")
    assert_same(second, run(other, name="alone"), 0.0)
    assert "0 views drawn" in run(one, *cache, name="again").text("eplusout.err")


def test_a_cache_keeps_the_fractions_of_an_awning_that_rests_rolled_up(run, tmp_path):
    cache = ("--gpu-shading-cache", str(tmp_path / "cache"))
    text = room(surface("Awning", AWNING), moving("Awning", "Extend", dy=-1, rest=0, schedule="Position"),
                constant(0.8), "Output:Variable,Awning,Surface Outside Face Sunlit Fraction,Timestep;\n")
    run(text, *cache)
    assert " 0 views drawn" in run(text, *cache, name="again").text("eplusout.err")


@pytest.mark.parametrize("name, position", [("slide", 1.5), ("given axis", -60)])
def test_a_mesh_moves_with_its_texture(run, tmp_path, name, position):
    """A panel with holes 0.2 m apart, as a mesh, and the same panel drawn where it stands."""
    _, shade, _, there = CASES[name]
    screen = "GPUShading:PerforatedScreen,Holes,Panel*,Texture,holes.png,,,,,,0.02;\n"
    pixels = np.zeros((20, 20), dtype=np.uint8)
    pixels[5:12, 8:16] = 255
    Image.fromarray(255 - pixels).save(tmp_path / "holes.png")

    def mesh(points):
        lines = [f"v {x:.9f} {y:.9f} {z:.9f}" for x, y, z in points]
        # Upwards and eastwards from the lower corner on the west side, as PANEL is drawn.
        lines += [f"vt {u} {v}" for u, v in ((0, 11.5), (0, 0), (5, 0), (5, 11.5))]
        return "\n".join([*lines, "f 1/1 2/2 3/3 4/4", ""])

    numbers = list(map(float, re.findall(r"-?\d+\.\d{12}", there)))
    (tmp_path / "drawn.obj").write_text(mesh(PANEL))
    (tmp_path / "there.obj").write_text(mesh(zip(*[iter(numbers)] * 3, strict=True)))

    def text(file, *more):
        return room(f"GPUShading:Geometry,Panel,{file},m,Z;\n", screen, *more)

    moves = run(text("drawn.obj", shade.replace(",Panel,", ",Panel*,"), constant(position)))
    assert_same(moves, run(text("there.obj"), name="there"))


PEREZ = ("--gpu-shading-sky=perez-patches",)


@pytest.mark.parametrize("options", [(), PEREZ], ids=["EnergyPlus", "Perez"])
def test_the_sky_follows_the_motion(run, options):
    """The diffuse light of the sky on the window at a constant position, and in a model that stands there."""
    variable = "Surface Outside Face Incident Sky Diffuse Solar Radiation Rate per Area"
    output = f"Output:Variable,Window,{variable},Timestep;\n"
    varying = "Schedule:Compact,Leaves,,Through: 12/31,For: AllDays,Until: 12:00,0,Until: 24:00,0.001;\n"
    far = surface("Far", [(500, 500, 0), (501, 500, 0), (501, 500, 1), (500, 500, 1)]).replace("Far,,", "Far,Leaves,")
    detailed = not options
    moves = run(room(slats(), CASES["centre line"][1], constant(35), output, detailed=detailed), *options)
    there = run(room(slats(35), varying, far, output, detailed=detailed), *options, name="there")
    first, second = series(moves, variable), series(there, variable)
    assert max(first.values()) > 20.0
    assert max(abs(first[time] - second[time]) for time in first) < 1e-3 * max(first.values())
    assert "position at rest" not in moves.text("eplusout.err")


def test_a_shade_at_rest_leaves_long_wave_radiation_as_it_is(run):
    variable = "Surface Outside Face Thermal Radiation to Sky Heat Transfer Coefficient"
    output = f"Output:Variable,Window,{variable},Timestep;\n"
    rests, alone, bare = (
        series(run(room(text, output, detailed=True), "--gpu-shading-reflections=energyplus", name=name), variable)
        for name, text in (("rests", slats() + CASES["centre line"][1] + constant(0)),
                           ("alone", slats()), ("bare", "")))
    assert max(abs(rests[time] - alone[time]) for time in alone) < 1e-4 * max(alone.values())
    assert max(alone.values()) < 0.9 * max(bare.values())


def test_pictures_show_other_positions(patched, weather, tmp_path):
    shade = CASES["centre line"][1] + constant(0)
    pictures = {}
    for name, text, options in (("moved", slats() + shade, ["--gpu-shading-positions", "shade=35"]),
                                ("there", slats(35), []), ("rest", slats() + shade, [])):
        (tmp_path / name).mkdir()
        (tmp_path / name / "model.idf").write_text(room(text))
        done = subprocess.run([patched.parent / "gpu_shading", "view", "model.idf", "-w", weather,
                               "--at", "08-21 13:00", "-o", "picture.png", *options],
                              cwd=tmp_path / name, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        pictures[name] = (tmp_path / name / "picture.png").read_bytes()
    assert pictures["moved"] == pictures["there"]
    assert pictures["moved"] != pictures["rest"]


def test_check_lists_both_ends_of_the_range(patched, weather, tmp_path):
    path = tmp_path / "model.idf"
    path.write_text(room(slats(), moving("Slat *", "Rotate", minimum=-30, maximum=60, rest=0, schedule="Position"),
                         constant(0)))
    program = [patched.parent / "gpu_shading", "check", path, "-w", weather]
    text = subprocess.run(program, capture_output=True, text=True, check=True).stdout
    assert text.count("moves from -30 to 60 deg with Shade") == len(SLATS)
    listed = json.loads(subprocess.run([*program, "--json"], capture_output=True, text=True, check=True).stdout)
    rows = {row["name"]: row["moves"] for row in listed["surfaces"] if "moves" in row}
    assert len(rows) == len(SLATS)
    for number, moves in enumerate(rows[f"SLAT {number}"] for number in range(len(SLATS))):
        assert (moves["shade"], moves["unit"], moves["positions"]) == ("Shade", "deg", [-30, 0, 60])
        for turn, outline in zip(moves["positions"], moves["outlines"], strict=True):
            numbers = re.findall(r"-?\d+\.\d{12}", slats(turn).split(f"Slat {number},")[1].split(";")[0])
            assert sum(outline, []) == pytest.approx(list(map(float, numbers)), abs=2e-6)


def test_pictures_draw_both_ends_of_the_range(patched, weather, tmp_path):
    """Seen from the south: a panel of 1 m that slides 3 m to the west is drawn here and there, 2 m apart."""
    drawn, shade, _, _ = CASES["slide"]
    (tmp_path / "model.idf").write_text(room(drawn, shade, constant(0)))
    pictures = []
    for options in ([], ["--range"]):
        done = subprocess.run([patched.parent / "gpu_shading", "view", "model.idf", "-w", weather, "--at",
                               "08-21 13:00", "--camera", "180,30", "-o", "picture.png", *options],
                              cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        pictures.append(np.asarray(Image.open(tmp_path / "picture.png").convert("L"), dtype=int))
    columns = np.flatnonzero((np.abs(pictures[0] - pictures[1]) > 20).any(axis=0))
    [gap] = np.flatnonzero(np.diff(columns) > 40)
    west, east = columns[:gap + 1], columns[gap + 1:]
    metre = (east[0] - west[0]) / 3
    assert west[-1] - west[0] == pytest.approx(metre, abs=4) and east[-1] - east[0] == pytest.approx(metre, abs=4)
    assert metre > 40


MOVES = """() => {
  const [motion] = content.motions;
  const [number] = motion.surfaces;
  return {seen: content.days[0].hours.map((_, hour) => {
    go(0, hour);
    const [first, end] = view.opaque.ranges.get(number);
    const {array} = view.opaque.geometry.attributes.position;
    const heights = [...array.slice(3 * first, 3 * end)].filter((_, i) => i % 3 === 2);
    return {text: document.getElementById("moment").textContent, rise: Math.max(...heights) - Math.min(...heights)};
  })};
}"""


def test_the_page_moves_its_shades(run, tmp_path):
    done = run(room(slats(), CASES["centre line"][1], STEPS), *REPORT)
    page = done.folder / "report" / "index.html"
    content = content_of(page)
    [motion] = content["motions"]
    ends = {row["hour"]: float(row["Shade position [deg]"]) for row in rows(done)}  # the last timestep of each
    hours = [ends[str(hour)] for hour, *_ in content["days"][0]["hours"]]

    def shorts(text):
        return np.frombuffer(base64.b64decode(text), "<u2")

    assert [motion["positions"][i] for i in shorts(motion["hours"])] == hours
    assert len(set(hours)) > 8
    geometry = content["geometry"]
    places = geometry["low"] + geometry["step"] * shorts(motion["places"]).reshape(len(SLATS), -1, 4, 3).astype(float)
    names = [content["names"][number] for number in motion["surfaces"]]
    for name, outlines in zip(names, places, strict=True):
        for turn, outline in zip(motion["positions"], outlines, strict=True):
            numbers = re.findall(r"-?\d+\.\d{12}", slats(turn).upper().split(f"{name},")[1].split(";")[0])
            assert outline.ravel() == pytest.approx(list(map(float, numbers)), abs=geometry["step"])
    looked = look_at(page, 1000, MOVES, tmp_path, *SOFTWARE_WEBGL)
    assert looked["troubles"] == []
    for seen, turn in zip(looked["seen"], hours, strict=True):
        assert f"Shade at {turn:g} deg" in seen["text"]
        assert seen["rise"] == pytest.approx(0.2 * math.sin(math.radians(turn)), abs=2 * geometry["step"])


AT_REST = """() => {
  document.getElementById("colouring").value = "energy";
  document.getElementById("colouring").dispatchEvent(new Event("change"));
  document.getElementById("tab-sky").click();
  const text = (id) => document.getElementById(id).textContent;
  return {names: [...document.querySelectorAll("#numbers dt")].map((name) => name.textContent),
    scale: text("legend-title"), sky: text("sky-caption")};
}"""


def test_the_page_says_which_numbers_are_of_shades_at_rest(run, tmp_path):
    """Masks show shades at rest, while maps move them as the run does."""
    done = run(room(slats(), CASES["centre line"][1], constant(35)), *REPORT, "--gpu-shading-maps")
    page = done.folder / "report" / "index.html"
    seen = look_at(page, 1000, AT_REST, tmp_path, *SOFTWARE_WEBGL)
    assert seen["troubles"] == []
    stated = {name: "moving shades at rest" in name for name in seen["names"]}
    assert {name.partition(",")[0] for name, said in stated.items() if said} == {"Sky view factor"}
    assert "Beam energy" in "".join(seen["names"]) and "at rest" not in seen["scale"]
    assert "(moving shades at rest)" in seen["sky"]


def test_a_sky_that_does_not_follow_is_stated(run):
    text = room(slats(), CASES["centre line"][1], constant(35))
    assert "diffuse light of the sky is that of the position at rest" in run(text).text("eplusout.err")


DRAWN = {
    "more positions than contexts": slats() + moving("Slat *", "Rotate", step=0.5, schedule="Position")
    + "GPUShading:PerforatedScreen,Mesh,Slat 1,Round,,Straight,0.05,,0.1,,0.001;\n"
    + of_hours(*((hour, hour * 3.5) for hour in range(1, 25))),
    "control": slats() + moving("Slat *", "Rotate", step=1, control="TrackSun", minimum=-90, maximum=90, rest=0),
}


@pytest.mark.parametrize("name", DRAWN)
def test_opengl_draws_each_position_as_the_cpu_does(run, name):
    drawn, counted = (run(room(DRAWN[name]), f"--gpu-shading-device={device}", *REPORT, name=device)
                      for device in ("0", "cpu"))
    assert "shading rendered by CPU" not in drawn.text("eplusout.err")
    assert rows(drawn) == rows(counted) and len({row["Shade position [deg]"] for row in rows(drawn)}) > 10
    # The renderer's target.
    assert_same(drawn, counted, 1e-3)


def test_a_run_from_samples_is_within_its_stated_error(run):
    """Of a window, and of a slat, whose own normal turns."""
    output = ("RunPeriod,Year,1,1,,12,31,;\n"
              "Output:Variable,Window,Surface Outside Face Beam Solar Incident Angle Cosine Value,Timestep;\n"
              "Output:Variable,Slat 0,Surface Outside Face Sunlit Fraction,Timestep;\n")
    schedule = of_hours((11, 0), (13, 40), (24, 20))
    text = room(slats(), moving("Slat *", "Rotate", step=20, schedule="Position"), schedule, output)
    text = text.replace("No,No,No,Yes,No", "No,No,No,No,Yes")
    sampled = run(text, "--gpu-shading-update=sampled:coarse", year=True, name="sampled")
    rendered = run(text, year=True, name="rendered")
    found = re.search(r"(\d+) directions of the sun answered from samples at (\d+), .* sunlit fraction ([\d.]+)",
                      sampled.text("eplusout.err"))
    answered, samples, stated = int(found[1]), int(found[2]), float(found[3])
    assert samples >= 3 * 238 and answered > 10 * samples
    cosines = series(rendered, "Surface Outside Face Beam Solar Incident Angle Cosine Value")
    for receiver in ("WINDOW", "SLAT 0"):
        one, other = (series(done, FRACTION, receiver) for done in (sampled, rendered))
        errors = [abs(one[time] - other[time]) for time in other if cosines[time] > 0.05]
        assert len({round(other[time], 3) for time in other}) > 100
        assert 0.0 < sum(errors) / len(errors) <= stated, receiver


def sample(patched, weather, folder, *options, output="samples"):
    return subprocess.run([patched.parent / "gpu_shading", "sample", "model.idf", "-w", weather, "-o", output,
                           "--mode", "coarse", *options], cwd=folder, capture_output=True, text=True)


def test_samples_are_taken_at_each_position(patched, weather, tmp_path):
    def window(table):
        with open(table, newline="") as file:
            return {row["time"]: float(row["WINDOW"]) for row in csv.DictReader(file)}

    def folder(name, text):
        (tmp_path / name).mkdir()
        (tmp_path / name / "model.idf").write_text(text)
        return tmp_path / name

    shade = moving("Slat *", "Rotate", maximum=60, step=30, schedule="Position") + constant(0)
    moves = folder("moves", room(slats(), shade))
    done = sample(patched, weather, moves)
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in (moves / "samples").iterdir()) == ["Shade_0", "Shade_30", "Shade_60"]
    there = folder("there", room(slats(30)))
    assert sample(patched, weather, there).returncode == 0
    one, other = window(moves / "samples/Shade_30/year.csv"), window(there / "samples/year.csv")
    assert one.keys() == other.keys() and len(set(other.values())) > 1000
    assert max(abs(one[time] - other[time]) for time in one) < 1e-4
    assert json.loads((moves / "samples/Shade_30/samples.json").read_text())["positions"] == "Shade=30"

    single = sample(patched, weather, moves, "--gpu-shading-positions=Shade=30", output="single")
    assert single.returncode == 0, single.stderr
    assert (moves / "single/year.csv").read_bytes() == (moves / "samples/Shade_30/year.csv").read_bytes()
    mask = subprocess.run([patched.parent / "gpu_shading", "mask", "model.idf", "-w", weather, "-o", "mask",
                           "--gpu-shading-positions=Shade=30", "--samples", "samples/Shade_30", "--receiver", "Window"],
                          cwd=moves, capture_output=True, text=True)
    assert mask.returncode == 0, mask.stderr
    with open(moves / "mask/hours.csv", newline="") as file:
        hours = list(csv.DictReader(file))
    assert len(hours) > 50
    for row in hours:
        [fraction] = {value for when, value in one.items()
                      if when[5:] == f"{int(row['month']):02}-21 {int(row['hour']):02}:00"}
        if row["sunlit fraction"]:
            assert float(row["sunlit fraction"]) == pytest.approx(fraction, abs=1e-4)

    many = folder("many", room(slats(), moving("Slat *", "Rotate", step=0.5, schedule="Position"), constant(0)))
    refused = sample(patched, weather, many)
    assert refused.returncode != 0
    assert "181 or more positions to sample, expected at most 100" in refused.stderr
