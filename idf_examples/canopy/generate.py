#!/usr/bin/env python3
"""Writes the model of two rooms under a double-curved glass canopy of 500 panes.

    generate.py [--glass single|triple] [--turn DEGREES] > canopy.idf

The canopy follows the hyperbolic paraboloid z = 9 + (x / 12)^2 - (y / 10)^2 (metres, from its centre) over 25 x 20
cells of 1 m. Each pane is a square in its cell, in the surface's tangent plane there, turned by --turn about the
pane's own east-west centre line.
"""

import argparse
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from common import idf  # noqa: E402

COLUMNS, ROWS = 25, 20
CELL = 1.0
PANE = 0.98  # side of a pane, as a fraction of its cell's
HEIGHT, CURVE_X, CURVE_Y = 9.0, 12.0, 10.0

ROOMS = {"West Room": -8.0, "East Room": 0.0}  # x of the south-west corner
ROOM = (8.0, 8.0, 4.0)
ROOM_Y = -4.0
SKYLIGHT = 1.0  # from the room's edges
WINDOW = (1.0, 0.8, 7.0, 3.2)  # x, z, x, z in the south wall

GLASS = {"single": ["Canopy Pane"], "triple": ["Canopy Pane", "Canopy Gap"] * 2 + ["Canopy Pane"]}

HEAD = """\
! Two rooms under a double-curved glass canopy of {count} panes, {glass} glass, turned {turn:g} degrees.
! Written by generate.py --glass {glass} --turn {turn:g}.
! Weather: USA_CO_Golden-NREL.724666_TMY3.epw, which comes with EnergyPlus.

""" + idf.preamble("Canopy", idf.GOLDEN, idf.GOLDEN_DAY) + "\n" + idf.WALLS_AND_GLAZING + """
! The pane of Jones and Greenberg's hotel: 69 % of the sun at normal incidence; three make 34 %.
WindowMaterial:Glazing,Canopy Pane,SpectralAverage,,0.0057,0.69,0.07,0.07,0.8,0.08,0.08,0,0.84,0.84,0.9;
WindowMaterial:Gas,Canopy Gap,Air,0.012;
Construction,Canopy Glass,{layers};
GPUShading:TransparentShade,Canopy,Canopy *,Construction,Canopy Glass;

""" + idf.SOLAR_OUTPUTS


def surface(name, kind, zone, boundary, corners):
    return idf.surface(name, kind, "Outer Wall", zone, boundary, corners)


def glazing(name, wall, corners):
    return idf.opening(name, "Window", "Window", wall, corners)


def room(zone, x):
    w, d, h = ROOM
    y = ROOM_Y
    x2, y2 = x + w, y + d
    yield f"\nZone,{zone};\n"
    sides = {"South": ((x, y), (x2, y)), "East": ((x2, y), (x2, y2)), "North": ((x2, y2), (x, y2)),
             "West": ((x, y2), (x, y))}  # fmt: skip
    inner = "East" if zone == "West Room" else "West"
    for side, ((xa, ya), (xb, yb)) in sides.items():
        boundary = "Adiabatic" if side == inner else "Outdoors"
        yield surface(f"{zone} {side}", "Wall", zone, boundary,
                      [(xa, ya, h), (xa, ya, 0), (xb, yb, 0), (xb, yb, h)])  # fmt: skip
    yield surface(f"{zone} Roof", "Roof", zone, "Outdoors", [(x, y2, h), (x, y, h), (x2, y, h), (x2, y2, h)])
    yield surface(f"{zone} Floor", "Floor", zone, "Adiabatic", [(x2, y2, 0), (x2, y, 0), (x, y, 0), (x, y2, 0)])
    s = SKYLIGHT
    yield glazing(f"{zone} Skylight", f"{zone} Roof",
                  [(x + s, y2 - s, h), (x + s, y + s, h), (x2 - s, y + s, h), (x2 - s, y2 - s, h)])  # fmt: skip
    xa, za, xb, zb = WINDOW
    yield glazing(f"{zone} Window", f"{zone} South",
                  [(x + xa, y, zb), (x + xa, y, za), (x + xb, y, za), (x + xb, y, zb)])  # fmt: skip


def pane(column, row, turn):
    """The corners of one pane."""
    x = (column + 0.5 - COLUMNS / 2) * CELL
    y = (row + 0.5 - ROWS / 2) * CELL
    z = HEIGHT + (x / CURVE_X) ** 2 - (y / CURVE_Y) ** 2
    slope_x, slope_y = 2 * x / CURVE_X**2, -2 * y / CURVE_Y**2
    length = math.hypot(1, slope_x)
    east = (1 / length, 0, slope_x / length)
    # Perpendicular to east in the tangent plane, and the plane's normal.
    normal_length = math.sqrt(1 + slope_x**2 + slope_y**2)
    normal = (-slope_x / normal_length, -slope_y / normal_length, 1 / normal_length)
    north = (normal[1] * east[2] - normal[2] * east[1], normal[2] * east[0] - normal[0] * east[2],
             normal[0] * east[1] - normal[1] * east[0])  # fmt: skip
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    across = [c * n + s * up for n, up in zip(north, normal, strict=True)]
    half = PANE * CELL / 2
    return [tuple(m + half * (a * e + b * n) for m, e, n in zip((x, y, z), east, across, strict=True))
            for a, b in ((-1, 1), (-1, -1), (1, -1), (1, 1))]  # fmt: skip


def model(glass="single", turn=0.0):
    yield HEAD.format(count=COLUMNS * ROWS, glass=glass, turn=turn, layers=",".join(GLASS[glass]))
    for zone, x in ROOMS.items():
        yield from room(zone, x)
    for column in range(COLUMNS):
        for row in range(ROWS):
            yield idf.shade(f"Canopy {column + 1} {row + 1}", pane(column, row, turn))


def main():
    parser = argparse.ArgumentParser(description="Writes the model of two rooms under a glass canopy.")
    parser.add_argument("--glass", choices=GLASS, default="single", help="panes of one or three sheets")
    parser.add_argument("--turn", type=float, default=0.0, metavar="DEGREES", help="angle of each pane to the surface")
    arguments = parser.parse_args()
    sys.stdout.writelines(model(arguments.glass, arguments.turn))


if __name__ == "__main__":
    main()
