"""Angular transmittance of shades against what EnergyPlus lets through windows of the same constructions.

One wall to the east at the equinox, a step a minute: the sun rises straight in front of it and leaves along the
wall. In the wall, a window of each construction; and a window behind a shade of each construction, whose sunlit
fraction is what the shade lets through.
"""

import math
import sqlite3

import pytest
from shading_runs import energyplus
from shading_runs.version import input_version

# Solar transmittance, front and back reflectance at normal incidence.
CLEAR_3 = (0.837, 0.075, 0.075)
CLEAR_6 = (0.775, 0.071, 0.071)
IRON_FREE = (0.905, 0.082, 0.082)
BRONZE_6 = (0.482, 0.054, 0.054)
GREY_12 = (0.232, 0.048, 0.048)
LOW_E_6 = (0.600, 0.170, 0.220)
LOW_E_3 = (0.690, 0.150, 0.130)
MIRROR = (0.300, 0.600, 0.600)
PAPER = (0.690, 0.100, 0.100)
FOIL = (0.940, 0.050, 0.050)
FILM = (0.980, 0.010, 0.010)
AIRY = (0.990, 0.005, 0.005)


def dirty(pane, factor):
    return (*pane, factor)


# Name: panes from the outside, with a Dirt Correction Factor if there is a fourth number; or U-factor in W/(m2 K)
# and SHGC.
CASES = {
    "single clear": [CLEAR_6],
    "single iron-free": [IRON_FREE],
    "single bronze": [BRONZE_6],
    "single grey": [GREY_12],
    "single mirror": [MIRROR],
    "single low-e": [LOW_E_6],
    "single low-e above 0.645": [LOW_E_3],
    "foil": [FOIL],
    "film": [FILM],
    "airy film": [AIRY],
    "two foils": [FOIL, FOIL],
    "four foils": [FOIL] * 4,
    "film before glass": [FILM, CLEAR_6],
    "double clear": [CLEAR_6, CLEAR_6],
    "double low-e": [LOW_E_6, CLEAR_6],
    "double bronze": [BRONZE_6, CLEAR_6],
    "triple": [CLEAR_3, CLEAR_6, LOW_E_3],
    "triple iron-free": [IRON_FREE, IRON_FREE, IRON_FREE],
    "three panes of 0.69": [PAPER, PAPER, PAPER],
    "dirty": [dirty(CLEAR_6, 0.8)],
    "dirty low-e": [dirty(LOW_E_6, 0.7)],
    "dirty outside": [dirty(CLEAR_6, 0.6), CLEAR_6],
    "dirty inside": [CLEAR_6, dirty(CLEAR_6, 0.6)],
    "dirty both": [dirty(CLEAR_3, 0.9), dirty(CLEAR_3, 0.5)],
    "rated 2.0, 0.40": (2.0, 0.40),
    "rated 1.5, 0.28": (1.5, 0.28),
    "rated 1.2, 0.50": (1.2, 0.50),
    "rated 4.0, 0.62": (4.0, 0.62),
    "rated 5.8, 0.80": (5.8, 0.80),
    "rated 5.8, 0.25": (5.8, 0.25),
}

HEAD = f"Version,{input_version()};\n" + """\
SimulationControl,No,No,No,Yes,No;
Building,Box,0,Country,0.04,0.4,FullExterior,25,6;
Timestep,60;
ShadowCalculation,PolygonClipping,Timestep;
Site:Location,Equator,0.01,0,0,10;
SizingPeriod:DesignDay,21 March,3,21,SummerDesignDay,32,10,DefaultMultipliers,,WetBulb,22,,,,,97600,3,230,
  No,No,No,ASHRAEClearSky,,,,,1.0;
GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;
Material:NoMass,Insulation,Rough,3,0.9,0.7,0.7;
WindowMaterial:Gas,Air,Air,0.012;
Construction,Outer Wall,Insulation;
Zone,Box;
Output:SQLite,Simple;
Output:Variable,*,Surface Window Transmitted Beam Solar Radiation Rate,Timestep;
Output:Variable,*,Surface Outside Face Incident Beam Solar Radiation Rate per Area,Timestep;
Output:Variable,*,Surface Outside Face Beam Solar Incident Angle Cosine Value,Timestep;
Output:Variable,*,Surface Outside Face Sunlit Fraction,Timestep;
"""
LENGTH, DEPTH, HEIGHT = 260.0, 6.0, 4.0  # of the box, m; its front runs along y at x = 0
WIDTH, SILL, TOP = 2.0, 1.0, 3.0  # of a window, m
GAP, MARGIN = 0.05, 0.6  # of a shade from its window, and beyond its edges, m


def construction(name, panes):
    """Its objects as text."""
    if isinstance(panes, tuple):
        return (f"WindowMaterial:SimpleGlazingSystem,{name} glass,{panes[0]},{panes[1]};\n"
                f"Construction,{name},{name} glass;\n")
    parts, layers = [], []
    for number, (t, front, back, *dirt) in enumerate(panes):
        layers.append(f"{name} pane {number}")
        parts.append(f"WindowMaterial:Glazing,{layers[-1]},SpectralAverage,,0.006,{t},{front},{back},"
                     f"{t},{front},{back},0,0.84,0.84,{','.join(map(str, [0.9, *dirt]))};\n")
    return "".join(parts) + f"Construction,{name}," + ",Air,".join(layers) + ";\n"


def model():
    """The input file as text."""

    def vertices(points):
        return ",\n".join(f"  {x},{y},{z}" for x, y, z in points) + ";\n"

    def wall(name, kind, points):
        return (f"BuildingSurface:Detailed,{name},{kind},Outer Wall,Box,,Outdoors,,SunExposed,WindExposed,,4,\n"
                + vertices(points))

    n, d, h = LENGTH, -DEPTH, HEIGHT
    parts = [
        HEAD,
        wall("Front", "Wall", [(0, 0, h), (0, 0, 0), (0, n, 0), (0, n, h)]),
        wall("Right", "Wall", [(0, n, h), (0, n, 0), (d, n, 0), (d, n, h)]),
        wall("Back", "Wall", [(d, n, h), (d, n, 0), (d, 0, 0), (d, 0, h)]),
        wall("Left", "Wall", [(d, 0, h), (d, 0, 0), (0, 0, 0), (0, 0, h)]),
        wall("Roof", "Roof", [(d, 0, h), (0, 0, h), (0, n, h), (d, n, h)]),
        wall("Base", "Floor", [(0, 0, 0), (d, 0, 0), (d, n, 0), (0, n, 0)]),
    ]
    def window(name, glazing, low):
        return f"FenestrationSurface:Detailed,{name},Window,{glazing},Front,,,,,4,\n" + vertices(
            [(0, low, TOP), (0, low, SILL), (0, low + WIDTH, SILL), (0, low + WIDTH, TOP)])

    for number, (case, panes) in enumerate(CASES.items()):
        name = case.replace(",", "")
        low = 1.0 + 4.0 * WIDTH * number
        behind = low + 2.0 * WIDTH
        bottom, top = SILL - MARGIN, TOP + MARGIN
        left, right = behind - MARGIN, behind + WIDTH + MARGIN
        parts += [construction(name, panes), window(f"{name} window", name, low),
                  window(f"{name} shaded", name, behind),
                  f"Shading:Building:Detailed,{name} shade,,4,\n",
                  vertices([(GAP, left, top), (GAP, left, bottom), (GAP, right, bottom), (GAP, right, top)]),
                  f"GPUShading:TransparentShade,{name} shade,{name} shade,Construction,{name};\n"]
    return "".join(parts)


@pytest.fixture(scope="module")
def measured(patched, weather, tmp_path_factory):
    """{case: [(angle in degrees, transmitted / incident of its window, sunlit fraction behind its shade)]}."""
    folder = tmp_path_factory.mktemp("glazing")
    path = folder / "glazing.idf"
    path.write_text(model())
    run = energyplus.run(patched, path, weather, folder / "out", ["--gpu-shading"])
    assert run.completed, run.severe
    with sqlite3.connect(run.folder / "eplusout.sql") as data:
        series = {}
        for key, name, time, value in data.execute(
                "SELECT KeyValue, Name, TimeIndex, Value FROM ReportData JOIN ReportDataDictionary"
                " USING (ReportDataDictionaryIndex)"):
            series.setdefault((key, name), {})[time] = value
    data.close()
    result = {}
    for case in CASES:
        key = case.replace(",", "").upper()
        transmitted, incident, cosine = (series[f"{key} WINDOW", f"Surface {name}"] for name in (
            "Window Transmitted Beam Solar Radiation Rate",
            "Outside Face Incident Beam Solar Radiation Rate per Area",
            "Outside Face Beam Solar Incident Angle Cosine Value"))
        behind = series[f"{key} SHADED", "Surface Outside Face Sunlit Fraction"]
        area = WIDTH * (TOP - SILL)
        result[case] = [(math.degrees(math.acos(cosine[time])), transmitted[time] / (area * incident[time]),
                         behind[time])
                        for time in incident if incident[time] > 0.0]
    return result


@pytest.mark.parametrize("case", CASES)
def test_shade_lets_through_what_a_window_does(case, measured):
    points = [point for point in measured[case] if point[0] <= 82.0]
    assert len(points) > 200
    assert min(points)[0] < 5.0
    worst = max(points, key=lambda point: abs(point[1] - point[2]))
    print(f"{case}: {abs(worst[1] - worst[2]):.1e} at {worst[0]:.0f} degrees")
    # Sampled in single precision.
    assert abs(worst[1] - worst[2]) < 5e-7
