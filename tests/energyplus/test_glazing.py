"""Angular transmittance of glazing against what EnergyPlus lets through windows of the same constructions.

One wall to the east at the equinox, a window of each construction in it, a step a minute: the sun rises
straight in front of them and leaves along the wall. EnergyPlus keeps a polynomial in the cosine fitted to
steps of 10 degrees, where ours follows the model itself: they may differ by that fit, and by nothing else.
"""

import math
import os
import sqlite3
import subprocess
from fractions import Fraction

import pytest
from conftest import REPOSITORY
from shading_runs import energyplus

# Solar transmittance, front and back reflectance at normal incidence.
CLEAR_3 = (0.837, 0.075, 0.075)
CLEAR_6 = (0.775, 0.071, 0.071)
BRONZE_6 = (0.482, 0.054, 0.054)
LOW_E_6 = (0.600, 0.170, 0.220)
LOW_E_3 = (0.690, 0.150, 0.130)
PAPER = (0.690, 0.100, 0.100)

# Name: panes from the outside, or U-factor in W/(m2 K) and SHGC.
CASES = {
    "single clear": [CLEAR_6],
    "single bronze": [BRONZE_6],
    "single low-e": [LOW_E_6],
    "single low-e above 0.645": [LOW_E_3],
    "double clear": [CLEAR_6, CLEAR_6],
    "double low-e": [LOW_E_6, CLEAR_6],
    "triple": [CLEAR_3, CLEAR_6, LOW_E_3],
    "three panes of 0.69": [PAPER, PAPER, PAPER],
    "rated 2.0, 0.40": (2.0, 0.40),
    "rated 1.5, 0.28": (1.5, 0.28),
    "rated 1.2, 0.50": (1.2, 0.50),
    "rated 4.0, 0.62": (4.0, 0.62),
    "rated 5.8, 0.80": (5.8, 0.80),
    "rated 5.8, 0.25": (5.8, 0.25),
}

HEAD = """\
Version,25.2;
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
"""
LENGTH, DEPTH, HEIGHT = 60.0, 6.0, 4.0  # of the box, m; its front runs along y at x = 0
WIDTH, SILL, TOP = 2.0, 1.0, 3.0  # of a window, m


def construction(name, panes):
    """Its objects as text."""
    if isinstance(panes, tuple):
        return (f"WindowMaterial:SimpleGlazingSystem,{name} glass,{panes[0]},{panes[1]};\n"
                f"Construction,{name},{name} glass;\n")
    parts, layers = [], []
    for number, (t, front, back) in enumerate(panes):
        layers.append(f"{name} pane {number}")
        parts.append(f"WindowMaterial:Glazing,{layers[-1]},SpectralAverage,,0.006,{t},{front},{back},"
                     f"{t},{front},{back},0,0.84,0.84,0.9;\n")
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
    for number, (case, panes) in enumerate(CASES.items()):
        name = case.replace(",", "")
        low = 1.0 + 2.0 * WIDTH * number
        parts.append(construction(name, panes))
        parts.append(f"FenestrationSurface:Detailed,{name} window,Window,{name},Front,,,,,4,\n")
        parts.append(vertices([(0, low, TOP), (0, low, SILL), (0, low + WIDTH, SILL), (0, low + WIDTH, TOP)]))
    return "".join(parts)


@pytest.fixture(scope="module")
def measured(official, weather, tmp_path_factory):
    """{case: [(angle in degrees, transmitted / incident)]} of EnergyPlus."""
    folder = tmp_path_factory.mktemp("glazing")
    path = folder / "glazing.idf"
    path.write_text(model())
    run = energyplus.run(official, path, weather, folder / "out")
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
        key = case.replace(",", "").upper() + " WINDOW"
        transmitted, incident, cosine = (series[key, f"Surface {name}"] for name in (
            "Window Transmitted Beam Solar Radiation Rate",
            "Outside Face Incident Beam Solar Radiation Rate per Area",
            "Outside Face Beam Solar Incident Angle Cosine Value"))
        area = WIDTH * (TOP - SILL)
        result[case] = [(math.degrees(math.acos(cosine[time])), transmitted[time] / (area * incident[time]))
                        for time in incident if incident[time] > 0.0]
    return result


@pytest.fixture(scope="module")
def printer():
    build = REPOSITORY / os.environ.get("GPU_SHADING_BUILD", "build")
    program = build / "tests" / "unit" / "optics" / "print_transmittance"
    if not program.is_file():
        pytest.skip(f"{program} is missing: run scripts/build")
    return program


def ours(printer, panes):
    """tau at 0, 1, .. 90 degrees."""
    arguments = ["simple", *panes] if isinstance(panes, tuple) else ["layers", *(x for pane in panes for x in pane)]
    run = subprocess.run([printer, *map(str, arguments)], check=True, capture_output=True, text=True)
    return [float(line.split()[1]) for line in run.stdout.splitlines()]


def fitted(tau):
    """The polynomial c1 x + .. + c6 x^6 in the cosine that is nearest to 0, 10, .. 90 degrees, as a function.

    Engineering Reference, "Glazing System Properties". The normal equations are ill-conditioned: solved exactly.
    """
    cosines = [Fraction(math.cos(math.radians(angle))) for angle in range(0, 91, 10)]
    values = [Fraction(value) for value in tau[::10]]
    powers = range(1, 7)
    rows = [[sum(x ** (i + j) for x in cosines) for j in powers]
            + [sum(y * x**i for x, y in zip(cosines, values, strict=True))] for i in powers]
    for pivot in range(len(rows)):
        for row in range(len(rows)):
            if row != pivot:
                factor = rows[row][pivot] / rows[pivot][pivot]
                rows[row] = [a - factor * b for a, b in zip(rows[row], rows[pivot], strict=True)]
    terms = [float(row[-1] / row[i]) for i, row in enumerate(rows)]
    return lambda angle: sum(c * math.cos(math.radians(angle)) ** (i + 1) for i, c in enumerate(terms))


def straight(tau):
    """Between whole degrees."""
    return lambda angle: tau[int(angle)] + (angle - int(angle)) * (tau[int(angle) + 1] - tau[int(angle)])


def largest_difference(model, points):
    """And the angle that has it."""
    return max((abs(model(angle) - value), angle) for angle, value in points)


@pytest.mark.parametrize("case", CASES)
def test_fitted_as_energyplus_does_it_is_energyplus(case, measured, printer):
    points = [(angle, value) for angle, value in measured[case] if angle < 89.9]
    assert largest_difference(fitted(ours(printer, CASES[case])), points)[0] < 1e-7


@pytest.mark.parametrize("case", CASES)
def test_itself_is_near_energyplus(case, measured, printer):
    points = [(angle, value) for angle, value in measured[case] if angle <= 80.0]
    assert len(points) > 200
    assert min(points)[0] < 5.0
    assert largest_difference(straight(ours(printer, CASES[case])), points)[0] < 0.005
