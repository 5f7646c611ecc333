"""Lean input: shading surfaces left out of what EnergyPlus reads give the answers that they gave in it."""

import collections
import csv
import itertools
import math
import os
import re
import subprocess

import pytest
from output_files import values_of
from shading_runs import energyplus, input_file, results
from test_models import MODELS, RUN_PERIOD_FIELDS, index

RESOLUTION = 512
# The same casters before the same receivers. Bounds are wider than what was found: no difference at all.
PIXELS = 3 / RESOLUTION**2
MEAN = 1e-6
LOADS = 1e-4

SKY = "Surface Outside Face Incident Sky Diffuse Solar Radiation Rate per Area"
LOAD_VARIABLES = ("Zone Ideal Loads Zone Total Heating Energy", "Zone Ideal Loads Zone Total Cooling Energy",
                  "Zone Windows Total Transmitted Solar Radiation Energy", "Zone Air Temperature")


def instrument(model):
    results.instrument(model)
    for variable in (SKY, *LOAD_VARIABLES):
        model.add_output_variable(variable, "Hourly")


@pytest.fixture
def run_both(patched, weather, tmp_path):
    """The runs of one model without and with lean input, by text or by path."""

    def call(model, options=("-D",), weather=weather, days=()):
        if isinstance(model, str):
            path = tmp_path / "model.idf"
            copy = input_file.Idf(model)
        else:
            path, copy = model, input_file.read(model)
        instrument(copy)
        for place, value in zip(RUN_PERIOD_FIELDS, days or (), strict=False):
            copy.set_field("RunPeriod", place, str(value))
        placed = input_file.place_copy(copy, path, tmp_path / "input")
        runs = [energyplus.run(patched, placed, weather, tmp_path / lean,
                               ["--gpu-shading", f"--gpu-shading-resolution={RESOLUTION}",
                                f"--gpu-shading-lean={lean}", *options]) for lean in ("off", "on")]
        for run in runs:
            assert run.completed, run.why()
        # Fewer for surfaces of which EnergyPlus finds fault with the outline.
        assert [message for message in runs[1].severe if message not in runs[0].severe
                and "degenerate surfaces" not in message] == []
        return runs

    return call


def remark(run):
    """What the run says on lean input; it must say the same in .err and in .eio."""
    lines = [line.removeprefix("gpu_shading: ") for line in run.our_lines if "lean input" in line]
    described = re.findall(r"^GPU Shading Lean Input,\d+,(.*)$", run.text("eplusout.eio"), re.MULTILINE)
    assert lines == described
    return lines[0] if lines else ""


def assert_alike(full, lean):
    assert remark(full) == ""
    assert "hidden from EnergyPlus, but still rendered" in remark(lean)
    reference, answer = results.Results(full.folder), results.Results(lean.folder)
    found = results.differences(reference, answer)
    assert found
    # Every hour, the sun before the receiver or not.
    all_hours = [abs(a - b) for name in reference.receivers
                 for a, b in zip(reference.values[results.SUNLIT][name], answer.values[results.SUNLIT][name],
                                 strict=True)]
    print(f"sunlit: mean {sum(all_hours) / len(all_hours):.1e}, max {max(all_hours):.1e}; {remark(lean)}")
    assert max(all_hours) <= PIXELS
    assert sum(all_hours) / len(all_hours) < MEAN
    for variable in (SKY, *LOAD_VARIABLES):
        before, after = (values_of(run, variable, "Hourly") for run in (full, lean))
        for name in before.keys() & after.keys():
            total = sum(map(abs, before[name]))
            difference = sum(abs(a - b) for a, b in zip(before[name], after[name], strict=True))
            assert difference <= LOADS * max(total, 1.0), (variable, name, difference, total)
        if variable in LOAD_VARIABLES:
            assert before.keys() == after.keys()
    return found


def shade(kind, name, points, fields="", count=""):
    """A detailed shading surface; fields: a base surface and its comma, a transmittance schedule."""
    coordinates = ",".join(f"{value:.9g}" for point in points for value in point)
    return f"Shading:{kind}:Detailed,{name},{fields},{count},{coordinates};\n"


def test_many_louvres(run_both, louvres):
    full, lean = run_both(louvres(120))
    assert_alike(full, lean)
    assert remark(lean).startswith("lean input: 120 shading surfaces hidden")
    counted = [re.search(r"(\d+) casters", run.rendering)[1] for run in (full, lean)]
    assert counted[0] == counted[1]
    assert "PLACEHOLDER" not in lean.text("eplusout.err")


def soffit(azimuth, tilt):
    """A receiver of 2 x 2 m at (20 m that way, 8 m up) and a screen 3 m before it."""
    way = math.radians(azimuth)
    out = (math.sin(way), math.cos(way), 0.0)  # the way it faces, seen from above
    along = (-out[1], out[0], 0.0)
    slope = math.radians(tilt)
    up = tuple(-math.cos(slope) * value for value in out[:2]) + (math.sin(slope),)
    centre = (20 * out[0], 20 * out[1], 8.0)
    corners = ",".join(f"{centre[i] + s * along[i] + t * up[i]:.6f}"
                       for s, t in ((-1, 1), (-1, -1), (1, -1), (1, 1)) for i in range(3))
    yield (f"BuildingSurface:Detailed,Soffit {azimuth},Wall,Outer Wall,Box,,Outdoors,,SunExposed,WindExposed,0.5,4,"
           f"{corners};\n")
    yield shade("Building", f"Screen {azimuth}",
                [(23 * out[0] + side * along[0], 23 * out[1] + side * along[1], height)
                 for side, height in ((-0.5, 8.2), (-0.5, 2), (0.5, 2), (0.5, 8.2))])


@pytest.mark.parametrize("tilt", [90, 150, 165, 175, 178])
def test_soffits_of_any_tilt_are_asked_for(run_both, box, tilt):
    """What looks down sees the sun while that is low: for minutes, so the steps are minutes."""
    text = box.replace("Timestep,4;", "Timestep,60;")
    text += "".join(part for azimuth in range(0, 360, 45) for part in soffit(azimuth, tilt))
    full, lean = run_both(text)
    found = [each for each in assert_alike(full, lean) if each.receiver.name.startswith("SOFFIT")]
    assert len(found) >= 2
    assert all(each.receiver.tilt == pytest.approx(tilt, abs=0.01) for each in found)
    assert any(value < 0.95 for each in found for value in each.reference), "no screen shades any"


def vertices(patched, model, lean):
    """{surface: [x, y, z]} of every polygon that the renderer gets."""
    done = subprocess.run([patched.parent / "gpu_shading", "check", "--vertices", model], capture_output=True,
                          text=True, env=os.environ | {"GPU_SHADING_LEAN": lean})
    assert done.returncode == 0, done.stderr
    found = collections.defaultdict(list)
    for row in csv.DictReader(done.stdout.splitlines()):
        found[row["surface"]].append([float(row[f"{axis} [m]"]) for axis in "xyz"])
    return found


def assert_same_vertices(patched, model, but=()):
    full, lean = vertices(patched, model, "off"), vertices(patched, model, "on")
    assert full.keys() == lean.keys()
    for name in full.keys() - set(but):
        assert len(full[name]) == len(lean[name]), name
        for before, after in zip(full[name], lean[name], strict=True):
            # EnergyPlus hands over single precision.
            assert before == pytest.approx(after, abs=1e-6, rel=1e-7), name


OUTLINES = {
    "Quad": [(-3, -4, 0), (2, -4.5, 0), (2, -4.5, 3.25), (-3, -4, 3)],
    "Tri": [(7, -1, 0.5), (9, -3, 0.5), (8, -2, 4)],
    "Penta": [(1, -6, 0), (5, -6, 0), (6, -6, 2), (3, -6, 4), (0, -6, 2)],
    "Hexa": [(1, -8, 0), (5, -8, 0), (6, -8, 2), (5, -8, 3), (1, -8, 3), (0, -8, 2)],
    "L": [(1, -13, 0), (5, -13, 0), (5, -13, 1), (3, -13, 1), (3, -13, 3), (1, -13, 3)],
    # Of vertices within 1 cm EnergyPlus drops one.
    "Near": [(1, -9, 0), (5, -9, 0), (5, -9, 0.005), (5, -9, 3), (1, -9, 3)],
    "Near Last": [(1, -10, 0), (5, -10, 0), (5, -10, 3), (1, -10, 3), (1.004, -10, 0.004)],
    "Thin": [(1, -11, 0), (5, -11, 0), (5, -11, 0.006), (1, -11, 0.006)],
    "Two Near": [(1, -7, 0), (5, -7, 0), (5.003, -7, 0.003), (5.005, -7, 0.006), (5, -7, 4), (1, -7, 4)],
    # And of those in a line, which changes no shadow.
    "Straight": [(1, -12, 0), (3, -12, 0), (5, -12, 0), (5, -12, 3), (1, -12, 3)],
}
STRAIGHT = [f"{kind} STRAIGHT" for kind in ("SITE", "BUILDING", "ZONE")]


def outlines():
    for kind, fields in (("Site", ""), ("Building", ""), ("Zone", "South,")):
        for place, (name, points) in enumerate(OUTLINES.items()):
            yield shade(kind, f"{kind} {name}", points, fields, ("", "autocalculate", len(points))[place % 3])


RULES = list(itertools.product(["UpperLeftCorner", "LowerLeftCorner", "LowerRightCorner", "UpperRightCorner"],
                               ["Counterclockwise", "Clockwise"], ["Relative", "World"]))


@pytest.mark.parametrize("rules", RULES, ids=" ".join)
def test_vertices_are_those_of_energyplus(patched, box, rules, tmp_path):
    text = box.replace("UpperLeftCorner,Counterclockwise,World;", ",".join(rules) + ";")
    text = re.sub(r"0,( +!- North Axis)", r"397.5,\1", text)
    text = text.replace("Zone,Box;", "Zone,Box,25,1.5,-2,0.75;") + "".join(outlines())
    assert "397.5" in text and "0.75;" in text and rules[0] in text
    model = tmp_path / "model.idf"
    model.write_text(text)
    assert_same_vertices(patched, model, STRAIGHT)


def test_epjson_is_rewritten_too(run_both, patched, official, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box + "".join(outlines()) + "ShadingProperty:Reflectance,Site Quad,0.3,0.3;\n")
    subprocess.run([official, "--convert-only", "-d", tmp_path, model], cwd=tmp_path, check=True, capture_output=True)
    converted = next(tmp_path.glob("*.epJSON"))
    assert_same_vertices(patched, converted, STRAIGHT)
    full, lean = run_both(converted)
    assert_alike(full, lean)
    assert "31 shading surfaces hidden" in remark(lean)


def rows_of(run):
    """Names of the surfaces that EnergyPlus has outputs of."""
    return set(values_of(run, results.SUNLIT, "Hourly"))


def test_placeholders_are_nothing_but_rows(run_both, box):
    full, lean = run_both(box)
    assert_alike(full, lean)
    assert rows_of(full) - rows_of(lean) == {"LOUVRE 1", "Mir-LOUVRE 1"}
    assert len(rows_of(lean) - rows_of(full)) == 8
    assert "outputs with key * show placeholders" in remark(lean)
    assert re.search(r"(\d+) casters", full.rendering)[1] == re.search(r"(\d+) casters", lean.rendering)[1]


def test_report_knows_no_placeholders(patched, weather, box, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box)
    run = energyplus.run(patched, model, weather, tmp_path / "run",
                         ["--gpu-shading-lean=on", f"--gpu-shading-report={tmp_path / 'report'}", "-D"])
    assert run.completed, run.why()
    assert "PLACEHOLDER" not in (tmp_path / "report" / "sunlit.csv").read_text()


HALF = "Schedule:Constant,Half,,0.5;\n"
VARYING = """
Schedule:Compact,Leaves,,Through: 4/30,For: AllDays,Until: 24:00,0.8,
  Through: 10/31,For: AllDays,Until: 12:00,0.2,Until: 24:00,0.4,Through: 12/31,For: AllDays,Until: 24:00,0.6;
"""
ACTUATED = VARYING + """
EnergyManagementSystem:Actuator,Leaf,Leaves,Schedule:Compact,Schedule Value;
EnergyManagementSystem:ProgramCallingManager,Caller,BeginTimestepBeforePredictor,Fall;
EnergyManagementSystem:Program,Fall,IF Hour >= 12,SET Leaf = 0.9,ELSE,SET Leaf = 0.1,ENDIF;
"""
CALCULATIONS = {
    "periodic": "ShadowCalculation,PolygonClipping,Periodic,20;",
    "timestep": "ShadowCalculation,PolygonClipping,Timestep,20;",
    "detailed sky": "ShadowCalculation,PolygonClipping,Periodic,20,15000,,512,DetailedSkyDiffuseModeling;",
    "detailed sky, timestep": "ShadowCalculation,PolygonClipping,Timestep,20,15000,,512,DetailedSkyDiffuseModeling;",
}


@pytest.mark.parametrize("calculation", CALCULATIONS.values(), ids=CALCULATIONS.keys())
@pytest.mark.parametrize("schedule", [HALF, VARYING, ACTUATED], ids=["constant", "varying", "actuated"])
def test_transmittance_schedules_are_honoured(run_both, box, schedule, calculation):
    """EnergyPlus shades the sky anew at every step only where some schedule of a shading surface varies."""
    name = schedule.split(",")[1].strip()
    text = re.sub(r"ShadowCalculation,[^;]*;[^\n]*", calculation, box) + schedule
    for place, y in enumerate((-0.5, -1.0, -1.5)):
        x = 1.5 + 0.7 * place
        text += shade("Building", f"Pane {place}", [(x, y, 3.5), (x, y, 0), (x + 1.2, y, 0), (x + 1.2, y, 3.5)], name)
    full, lean = run_both(text)
    assert_alike(full, lean)
    listed = [sorted(re.findall(r"^GPU Shading Surface,.*$", run.text("eplusout.eio"), re.MULTILINE))
              for run in (full, lean)]
    assert len(listed[0]) == 3 and listed[0] == listed[1]


PHOTOVOLTAICS = """
Generator:Photovoltaic,Cells,Louvre 3,PhotovoltaicPerformance:Simple,Performance,Decoupled;
PhotovoltaicPerformance:Simple,Performance,0.5,Fixed,0.2;
ElectricLoadCenter:Generators,Panels,Cells,Generator:Photovoltaic,1000;
ElectricLoadCenter:Distribution,Centre,Panels,Baseload,,,,DirectCurrentWithInverter,Inverter;
ElectricLoadCenter:Inverter:Simple,Inverter,,,,1;
Output:Variable,*,Generator Produced DC Electricity Energy,Hourly;
"""
SENSOR = """
EnergyManagementSystem:Sensor,Lit,Louvre 3,Surface Outside Face Sunlit Fraction;
EnergyManagementSystem:ProgramCallingManager,Caller,BeginTimestepBeforePredictor,Look;
EnergyManagementSystem:Program,Look,SET Kept = Lit;
EnergyManagementSystem:GlobalVariable,Kept;
EnergyManagementSystem:OutputVariable,Seen,Kept,Averaged,ZoneTimestep;
Output:Variable,*,Seen,Hourly;
"""
# What names a surface, and an output that tells whether it still works.
NAMES = {
    "output": ("Output:Variable,louvre 3,Surface Outside Face Sunlit Area,Hourly;", "Surface Outside Face Sunlit Area"),
    "pattern": ("Output:Variable,Louvre [3],Surface Outside Face Sunlit Area,Hourly;",
                "Surface Outside Face Sunlit Area"),
    "photovoltaics": (PHOTOVOLTAICS, "Generator Produced DC Electricity Energy"),
    "EMS sensor": (SENSOR, "Seen"),
}


@pytest.mark.parametrize("added, variable", NAMES.values(), ids=NAMES.keys())
def test_named_surface_stays(run_both, louvres, added, variable):
    full, lean = run_both(louvres(12) + added)
    assert_alike(full, lean)
    assert "11 shading surfaces hidden" in remark(lean)
    assert "1 kept (such as LOUVRE 3, which " in remark(lean)
    assert "LOUVRE 3" in rows_of(lean) and "LOUVRE 4" not in rows_of(lean)
    before, after = (values_of(run, variable, "Hourly") for run in (full, lean))
    assert after and any(sum(values) > 0 for values in after.values())
    for name, values in after.items():
        assert values == pytest.approx(before[name], rel=1e-4, abs=1e-6), name


REASONS = {
    "DElight": (lambda text: text + "Daylighting:Controls,Light,Box,DElight,,Continuous,,,,,,,,,Point,1,500;\n"
                    "Daylighting:ReferencePoint,Point,Box,3,3,0.8;\n", "Daylighting:Controls LIGHT"),
    "shading file": (lambda text: re.sub(r"ShadowCalculation,[^;]*;", "ShadowCalculation,PolygonClipping,Periodic,20,"
                                         "15000,SutherlandHodgman,512,SimpleSkyDiffuseModeling,Yes;", text),
                     "Output External Shading Calculation Results"),
    "transform": (lambda text: text + "GeometryTransform,XY,1.0,1.0;\n", "GeometryTransform"),
    "rotation": (lambda text: text + "Compliance:Building,90;\n", "Compliance:Building"),
}


@pytest.mark.parametrize("change, words", REASONS.values(), ids=REASONS.keys())
def test_off_with_the_reason_where_the_surfaces_are_needed(run_both, louvres, patched, change, words, tmp_path):
    text = change(louvres(3))
    full, lean = run_both(text)
    assert remark(lean).startswith("lean input is off: ")
    assert words.lower() in remark(lean).lower()
    assert rows_of(full) == rows_of(lean)
    reference, answer = results.Results(full.folder), results.Results(lean.folder)
    assert reference.values == answer.values
    model = tmp_path / "check.idf"
    model.write_text(text)
    done = subprocess.run([patched.parent / "gpu_shading", "check", model], capture_output=True, text=True,
                          env=os.environ | {"GPU_SHADING_LEAN": "on"})
    assert done.stdout.splitlines()[0] == remark(lean)


def test_few_surfaces_run_as_ever(patched, weather, box, louvres, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(box)
    run = energyplus.run(patched, model, weather, tmp_path / "few", ["--gpu-shading", "-D"])
    assert run.completed and remark(run) == ""
    model.write_text(louvres(200))
    run = energyplus.run(patched, model, weather, tmp_path / "many", ["--gpu-shading", "-D"])
    assert run.completed and "200 shading surfaces hidden" in remark(run)
    for name, lean_off in (("variable", {"environment": {"GPU_SHADING_LEAN": "off"}}),
                           ("flag", {"options": ["--gpu-shading-lean=off"]})):
        options = ["--gpu-shading", "-D", *lean_off.get("options", [])]
        run = energyplus.run(patched, model, weather, tmp_path / name, options, lean_off.get("environment"))
        assert run.completed and remark(run) == ""
    run = energyplus.run(patched, model, weather, tmp_path / "clip", ["--gpu-shading=off", "--gpu-shading-lean=on",
                                                                     "-D"])
    assert run.completed and remark(run) == "" and run.method == "PolygonClipping"


# Begin month and day, end month and day.
SHORT_RUN_PERIODS = {"10x_incr_100zones1win10overhangsFullExIn.idf": (4, 20, 4, 20),
                     "ASHRAE140_Case610.idf": (4, 20, 4, 24)}
WITH_SHADES = ("10x_incr_100zones1win10overhangsFullExIn.idf", "SolarShadingTest.idf",
               "SolarShadingTest.epJSON", "SolarShadingTest_DisableSelfShadingGroup.idf", "SurfaceTest.idf",
               "VentilationSimpleTest.idf", "ShadingSuite_South-HorVer-Trans5.idf", "ASHRAE140_Case610.idf")


@pytest.mark.parametrize("row", index(only=WITH_SHADES))
def test_other_peoples_models(row, run_both, patched):
    name, weather_name, period, flags = row
    assert_same_vertices(patched, MODELS / name)
    short = {"-D"} if period == "dd" else set()
    full, lean = run_both(MODELS / name, [*flags.split(), *short], energyplus.find_weather(weather_name),
                          days=SHORT_RUN_PERIODS.get(name))
    assert_alike(full, lean)


def test_our_models(run_both, courtyard, patched):
    assert_same_vertices(patched, courtyard)
    assert_alike(*run_both(courtyard))
