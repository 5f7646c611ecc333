#!/usr/bin/env python3
"""Runs the office for a year with its trees, with leaves all year, and with boxes in their place, and prints the solar
radiation of its window, and heating and cooling, as Markdown.

    study.py [-o DIR]
"""

import argparse
import re
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parents[1] / "scripts")]

import generate  # noqa: E402
from common import case_study  # noqa: E402
from shading_runs import results  # noqa: E402

WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"
MODEL = (HERE / "trees.idf").read_text(encoding="utf-8")
TREE = re.compile(r"GPUShading:Tree,[^;]*;\n")
COOLING = "Zone Air System Sensible Cooling Energy"
HEATING = "Zone Air System Sensible Heating Energy"
# Crowns of trees.geojson and of the oak: x, y, width, base and top, m.
CROWNS = ((-9, -11, 6.5, 2.5, 9.5), (-2, -11, 5.5, 2.5, 8.5), (5, -11, 6, 2.5, 9), (12, -11, 7, 2.5, 10),
          (19, -11, 2.5, 2.5, 7), (9, -6, 8, 2, 11))


def boxes():
    """Opaque ones around the crowns, as sides and a top."""
    text = ""
    for number, (x, y, width, base, top) in enumerate(CROWNS):
        w, e, s, n = x - width / 2, x + width / 2, y - width / 2, y + width / 2
        for side, (a, b) in enumerate((((w, s), (e, s)), ((e, s), (e, n)), ((e, n), (w, n)), ((w, n), (w, s)))):
            corners = ((*a, top), (*a, base), (*b, base), (*b, top))
            text += shade(f"Box {number} {side}", corners)
        text += shade(f"Box {number} top", ((w, s, top), (e, s, top), (e, n, top), (w, n, top)))
    return text


def shade(name, corners):
    places = ", ".join(f"{value:g}" for corner in corners for value in corner)
    return f"Shading:Site:Detailed, {name}, , {len(corners)}, {places};\n"


VARIANTS = {
    "none": TREE.sub("", MODEL),
    "trees, with leaves by the season": MODEL,
    "the same, the oak a mesh": generate.model(),
    "trees, with leaves all year": MODEL.replace("Deciduous", "Evergreen"),
    "opaque boxes": TREE.sub("", MODEL) + boxes(),
}


def main():
    parser = argparse.ArgumentParser(description="Compares trees and boxes before an office.")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/trees_study"), metavar="DIR",
                        help="folder for the runs")
    arguments = parser.parse_args()
    print("| before the window | solar, kWh | heating | cooling | seconds |")
    print("|---|---:|---:|---:|---:|")
    with case_study.replacing(arguments.output, "trees") as output:
        for number, (name, text) in enumerate(VARIANTS.items()):
            path = output.path / str(number) / "trees.idf"
            path.parent.mkdir()
            path.write_text(text, encoding="utf-8")
            shutil.copy(HERE / "trees.geojson", path.parent)
            (path.parent / "oak.obj").write_text(generate.crown(), encoding="utf-8")
            done = case_study.run_year(path, WEATHER, name)
            values = results.Results(done.folder, "Monthly")
            cells = (values.total(results.SOLAR, "WINDOW"), values.total(HEATING, "OFFICE"),
                     values.total(COOLING, "OFFICE"))
            print(f"| {name} | {' | '.join(f'{value:,.0f}' for value in cells)} | {done.seconds:.1f} |", flush=True)


if __name__ == "__main__":
    main()
