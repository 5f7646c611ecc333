"""Where EnergyPlus's polygon clipping is wrong: the smallest cases, against exact areas.

A window of 3 x 3 m and shades parallel to it, so that a shadow is the shade's own outline, moved; the union of
rectangles is exact. docs/explanation/accuracy.md has the figures that are printed here.
"""

import itertools
import math
import sqlite3

import pytest
import window_with_shades
from shading_runs import energyplus

HALF, LOW, HIGH = window_with_shades.SIZE / 2, 1.0, 1.0 + window_with_shades.SIZE
VARIABLES = ("Surface Outside Face Sunlit Fraction", "Site Solar Azimuth Angle", "Site Solar Altitude Angle")


def outline(distance, points):
    return [(x, -distance, z) for x, z in points]


def rectangle(left, right, bottom, top):
    return [(left, top), (left, bottom), (right, bottom), (right, top)]


# Name: shades as (distance, outline), and the rectangles (distance, left, right, bottom, top) that they are.
ELL = [(-1, 4.4), (-1, 1.2), (-0.6, 1.2), (-0.6, 4.0), (1, 4.0), (1, 4.4)]
STACK = [(0.3 + 0.02 * i, -1.2 + 0.02 * i, 0.8 + 0.02 * i, 1.4 - 0.03 * i, 3.6 - 0.03 * i) for i in range(13)]
SLATS = [(0.1, -30.0, 30.0, 1.005 + 0.02 * i, 1.009 + 0.02 * i) for i in range(150)]
CASES = {
    "L-shaped shade": ([(0.5, ELL)], [(0.5, -1, -0.6, 1.2, 4.4), (0.5, -0.6, 1, 4.0, 4.4)]),
    "13 shades one before the other": ([(d, rectangle(*sides)) for d, *sides in STACK], STACK),
    "slats of 4 mm": ([(d, rectangle(*sides)) for d, *sides in SLATS], SLATS),
}
# By how much polygon clipping is off, at least, at its worst; ours, at most, at a target error of 0.001.
CLIPPED, OURS = 0.05, 1e-3


def model(shades):
    """The input file as text."""
    text = window_with_shades.model("south", False, False)
    for number, (distance, points) in enumerate(shades):
        corners = ",\n".join(f"  {x:.6f},{y:.6f},{z:.6f}" for x, y, z in outline(distance, points))
        text += f"Shading:Building:Detailed,Shade {number},,{len(points)},\n{corners};\n"
    return text


def exact(rectangles, azimuth, altitude):
    """Sunlit fraction of the window."""
    g = math.radians(azimuth - 180.0)
    drop, slide = math.tan(math.radians(altitude)) / math.cos(g), math.tan(g)
    moved = [(max(left + d * slide, -HALF), min(right + d * slide, HALF),
              max(low - d * drop, LOW), min(high - d * drop, HIGH)) for d, left, right, low, high in rectangles]
    moved = [each for each in moved if each[0] < each[1] and each[2] < each[3]]
    xs = sorted({x for left, right, _, _ in moved for x in (left, right)})
    zs = sorted({z for _, _, low, high in moved for z in (low, high)})
    shaded = sum((x2 - x1) * (z2 - z1) for x1, x2 in itertools.pairwise(xs) for z1, z2 in itertools.pairwise(zs)
                 if any(left <= x1 and x2 <= right and low <= z1 and z2 <= high for left, right, low, high in moved))
    return 1.0 - shaded / window_with_shades.SIZE**2


def sunlit(program, weather, path, folder, flags):
    """{(azimuth, altitude): sunlit fraction} of the window while the sun is well before it."""
    run = energyplus.run(program, path, weather, folder, [*flags, "-D"])
    assert run.completed, run.why()
    with sqlite3.connect(f"file:{run.folder / 'eplusout.sql'}?mode=ro", uri=True) as data:
        columns = [[value for (value,) in data.execute(
            "SELECT Value FROM ReportData JOIN ReportDataDictionary USING (ReportDataDictionaryIndex)"
            " WHERE Name = ? ORDER BY TimeIndex", (name,))] for name in VARIABLES]
    data.close()
    return {(azimuth, altitude): value for value, azimuth, altitude in zip(*columns, strict=True)
            if altitude > 5.0 and abs(azimuth - 180.0) < 75.0}


@pytest.mark.parametrize("case", CASES)
def test_polygon_clipping_is_wrong_and_we_are_not(case, patched, weather, tmp_path):
    shades, rectangles = CASES[case]
    path = tmp_path / "model.idf"
    path.write_text(model(shades))
    clipped = sunlit(patched, weather, path, tmp_path / "clipped", [])
    ours = sunlit(patched, weather, path, tmp_path / "ours", ["--gpu-shading"])
    assert len(clipped) > 30 and clipped.keys() == ours.keys()
    truth = {sun: exact(rectangles, *sun) for sun in ours}
    worst = max(truth, key=lambda sun: abs(clipped[sun] - truth[sun]))
    largest = max(abs(ours[sun] - truth[sun]) for sun in truth)
    print(f"{case}: sun at {worst[0]:.1f}, {worst[1]:.1f}: polygon clipping {clipped[worst]:.4f}, exact "
          f"{truth[worst]:.4f}, ours {ours[worst]:.4f}; ours at most {largest:.1e} off")
    assert abs(clipped[worst] - truth[worst]) > CLIPPED
    assert largest < OURS
