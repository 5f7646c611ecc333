#!/usr/bin/env python3
"""Writes the box of idf_examples/box_with_louvres with level louvres before its south window that turn.

    generate.py [--louvres N] [--control none|fixed|block|summer|track] [--position DEGREES] > moving_louvres.idf

none: the louvres are level, without a GPUShading:MovingShade; fixed: they stand at a position; block: BlockBeam;
summer: BlockBeam from May to September, else level; track: TrackSun. The louvres are as deep as their rows are apart,
in 20 rows, each cut into pieces to give N in total.
"""

import argparse
import importlib.util
import sys
from pathlib import Path

ROWS = 20
MARGIN = 0.5  # beyond the window on each side, m
DISTANCE = 0.2  # from the wall to the louvres' axes, m

_box_file = Path(__file__).resolve().parents[1] / "box_with_louvres" / "generate.py"
_spec = importlib.util.spec_from_file_location("box_with_louvres", _box_file)
box = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(box)


def louvres(count):
    """The four corners of each louvre, counterclockwise as seen from above."""
    x0, z0, x1, z1 = box.WINDOW
    x0, x1 = x0 - MARGIN, x1 + MARGIN
    pitch = (z1 - z0) / ROWS
    inner, outer = -DISTANCE + pitch / 2, -DISTANCE - pitch / 2
    for row in range(ROWS + 1):
        pieces = max(1, count // ROWS)
        z = z0 + pitch * row
        for piece in range(pieces):
            left, right = x0 + (x1 - x0) * piece / pieces, x0 + (x1 - x0) * (piece + 1) / pieces
            yield [(left, inner, z), (left, outer, z), (right, outer, z), (right, inner, z)]


def moving_shade(control, position=0.0):
    """The object as text; the blank fields of an axis are its centre line's."""
    if control == "none":
        return ""
    head = "\nGPUShading:MovingShade,Louvres,Louvre *,Rotate,,,,,,,,0,80,5,"
    if control == "block":
        return head + ",BlockBeam,,South Window;\n"
    if control == "summer":
        days = ",For: AllDays,Until: 24:00,"
        return (f"\nSchedule:Compact,Summer,,Through: 4/30{days}0,Through: 9/30{days}1,Through: 12/31{days}0;\n"
                + head + ",BlockBeam,,South Window,Summer;\n")  # fmt: skip
    if control == "track":
        return head + ",TrackSun;\n"
    return f"\nSchedule:Constant,Louvre Position,,{position:g};\n" + head + ",Schedule,Louvre Position;\n"


def model(count=ROWS, control="block", position=0.0):
    """The whole input file as text."""
    head = box.HEAD.format(n=count)
    head = head.replace("Periodic,                !- Shading", "Timestep,                !- Shading")
    head = head.replace("  20;                      !- Shading Calculation Update Frequency\n",
                        "  20,                      !- Shading Calculation Update Frequency\n"
                        "  ,                        !- Maximum Figures in Shadow Overlap Calculations\n"
                        "  ,                        !- Polygon Clipping Algorithm\n"
                        "  ,                        !- Pixel Counting Resolution\n"
                        "  DetailedSkyDiffuseModeling;  !- Sky Diffuse Modeling Algorithm\n")
    head = head.replace(f"Written by generate.py {count}.", "Written by moving_louvres/generate.py.")
    parts = [head, *box.box()]
    for number, points in enumerate(louvres(count), 1):
        parts.append(f"\nShading:Building:Detailed,\n  Louvre {number},,4,\n" + box.vertices(points))
    return "".join(parts) + moving_shade(control, position)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--louvres", type=int, default=ROWS)
    parser.add_argument("--control", choices=("none", "fixed", "block", "summer", "track"), default="block")
    parser.add_argument("--position", type=float, default=0.0)
    chosen = parser.parse_args()
    sys.stdout.write(model(chosen.louvres, chosen.control, chosen.position))
