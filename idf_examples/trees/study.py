#!/usr/bin/env python3
"""Runs the office for a year with its trees, with leaves all year, and with boxes in their place, and prints the solar
radiation of its window, and heating and cooling, as Markdown.

    study.py [DIR]

DIR, by default ./trees_study, is a new folder for the runs.
"""

import re
import shutil
import sys
from pathlib import Path

import generate

import gpu_shading

HERE = Path(__file__).resolve().parent
WEATHER = gpu_shading.prefix() / "WeatherData" / "USA_CO_Golden-NREL.724666_TMY3.epw"
MODEL = (HERE / "trees.idf").read_text(encoding="utf-8")
TREE = re.compile(r"GPUShading:Tree,[^;]*;\n")
ENERGIES = ("Surface Window Transmitted Solar Radiation Energy", "Zone Air System Sensible Heating Energy",
            "Zone Air System Sensible Cooling Energy")
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


def run_year(text, folder):
    """The energies of a model, kWh, and the seconds that its run took."""
    folder.mkdir()
    (folder / "trees.idf").write_text(text, encoding="utf-8")
    (folder / "oak.obj").write_text(generate.crown(), encoding="utf-8")
    shutil.copy(HERE / "trees.geojson", folder)
    run = gpu_shading.run(folder / "trees.idf", WEATHER, folder / "run", arguments=["--gpu-shading-reflections=all"])
    kwh = [sum(months.sum() for months in run.values(name, "Monthly").values()) / 3.6e6 for name in ENERGIES]
    return kwh, run.summary().seconds


def main(folder="trees_study"):
    output = Path(folder)
    if output.exists():
        sys.exit(f"study.py: {output} exists already: name a new folder")
    output.mkdir(parents=True)
    print("| before the window | solar, kWh | heating | cooling | seconds |")
    print("|---|---:|---:|---:|---:|")
    for number, (name, text) in enumerate(VARIANTS.items()):
        kwh, seconds = run_year(text, output / str(number))
        print(f"| {name} | {' | '.join(f'{value:,.0f}' for value in kwh)} | {seconds:.1f} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
