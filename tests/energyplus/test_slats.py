"""Slats thinner than the centimetre within which EnergyPlus merges vertices, against the closed form.

EnergyPlus deletes one vertex of a slat of 4 mm, which leaves half of it, and stops at a slat of 1 mm.
"""

import math
import sqlite3

import pytest
import window_with_shades
from shading_runs import energyplus

DISTANCE = 0.1  # from the window, m
PITCH = 0.02  # m
# Of a sunlit fraction; measured: at most 1.2e-4 and 2.8e-4.
MEAN, MAX = 2.5e-4, 6e-4

BOTTOM, TOP = 1.0, 1.0 + window_with_shades.SIZE


def slats(width, count):
    """[(lower edge, upper edge)] in m."""
    return [(BOTTOM + PITCH * (i + 0.25), BOTTOM + PITCH * (i + 0.25) + width) for i in range(count)]


def model(width, count, distribution="FullExterior"):
    """The input file as text."""
    far, y = window_with_shades.FAR, -DISTANCE
    text = window_with_shades.model("south", False, False).replace("FullExterior", distribution)
    for number, (low, high) in enumerate(slats(width, count)):
        text += (f"Shading:Building:Detailed,Slat {number},,4,\n  {-far},{y},{high:.6f},{-far},{y},{low:.6f},"
                 f"{far},{y},{low:.6f},{far},{y},{high:.6f};\n")
    return text


def exact(width, count, azimuth, altitude):
    """Sunlit fraction of the window: shadows fall by the tangent of the profile angle and do not overlap."""
    g = math.radians(azimuth - 180.0)
    if altitude <= 0.0 or math.cos(g) <= 0.0:
        return 0.0
    drop = DISTANCE * math.tan(math.radians(altitude)) / math.cos(g)
    shaded = sum(max(0.0, min(high - drop, TOP) - max(low - drop, BOTTOM)) for low, high in slats(width, count))
    return 1.0 - shaded / window_with_shades.SIZE


@pytest.fixture
def run(patched, weather, tmp_path):
    def call(text, *options):
        path = tmp_path / "model.idf"
        path.write_text(text)
        return energyplus.run(patched, path, weather, tmp_path / "out", ["--gpu-shading", "-D", *options])

    return call


def assert_exact(done, width, count):
    assert done.completed, done.why()
    with sqlite3.connect(f"file:{done.folder / 'eplusout.sql'}?mode=ro", uri=True) as data:
        series = {}
        for name, time, value in data.execute(
                "SELECT Name, TimeIndex, Value FROM ReportData JOIN ReportDataDictionary"
                " USING (ReportDataDictionaryIndex)"):
            series.setdefault(name, {})[time] = value
    data.close()
    sunlit, azimuth, altitude = (series[name] for name in (
        "Surface Outside Face Sunlit Fraction", "Site Solar Azimuth Angle", "Site Solar Altitude Angle"))
    facing = [time for time in sunlit
              if altitude[time] > 5.0 and abs(azimuth[time] - 180.0) < 80.0]
    assert len(facing) > 30
    errors = [abs(sunlit[time] - exact(width, count, azimuth[time], altitude[time])) for time in facing]
    print(f"mean {sum(errors) / len(errors):.1e}, max {max(errors):.1e}")
    assert sum(errors) / len(errors) < MEAN
    assert max(errors) < MAX


# Fewer than 100 surfaces stay in EnergyPlus's input otherwise.
@pytest.mark.parametrize("count", [20, 150])
@pytest.mark.parametrize("width", [0.004, 0.001])
def test_slats_shade_with_their_own_width(run, width, count):
    done = run(model(width, count))
    assert_exact(done, width, count)
    assert f"lean input: {count} shading surfaces hidden" in done.text("eplusout.err")
    assert "degenerate" not in done.text("eplusout.err")


@pytest.mark.parametrize("distribution", ["FullExterior", "FullExteriorWithReflections"])
def test_slats_that_energyplus_sees_shade_with_their_own_width(run, distribution):
    count = 24
    done = run(model(0.004, count, distribution), "--gpu-shading-lean=off")
    assert_exact(done, 0.004, count)
    # EnergyPlus's own message, and ours in the same words.
    assert f"There are {count} degenerate surfaces" in done.text("eplusout.err")
    warnings = [line for line in done.text("eplusout.err").splitlines() if "coincident vertices (distance" in line]
    assert len(warnings) == 1
    assert f"of {count} shading surfaces: SLAT 0, SLAT 1," in warnings[0]
    assert f"it calls {count} of them degenerate" in warnings[0]


def test_where_energyplus_stops_at_a_slat_we_say_why(run):
    done = run(model(0.0003, 3), "--gpu-shading-lean=off")
    assert not done.completed
    errors = done.text("eplusout.err")
    assert "of 3 shading surfaces: SLAT 0, SLAT 1, SLAT 2; it calls 3 of them degenerate and may stop there" in errors
    assert errors.index("coincident vertices (distance") < errors.index("**  Fatal  **")
