#!/usr/bin/env python3
"""Runs the canopy's variants for a year and prints the solar radiation in each room as Markdown.

    study.py [-o DIR]
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import generate  # noqa: E402
from common import case_study  # noqa: E402
from shading_runs import results  # noqa: E402

WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"
VARIANTS = {
    "no canopy": None,
    "single glass, in the surface": ("single", 0),
    "single glass, panes turned 20 degrees": ("single", 20),
    "single glass, panes turned 90 degrees": ("single", 90),
    "triple glass, in the surface": ("triple", 0),
    "triple glass, panes turned 20 degrees": ("triple", 20),
}


def text_of(variant):
    if variant is None:
        # Without the panes and their TransparentShade.
        head = "".join(generate.model()).split("\nShading:Building:Detailed")[0]
        return head.replace("GPUShading:TransparentShade,Canopy,Canopy *,Construction,Canopy Glass;\n", "")
    return "".join(generate.model(*variant))


def run(name, variant, folder):
    folder.mkdir()
    path = folder / "canopy.idf"
    path.write_text(text_of(variant))
    done = case_study.run_year(path, WEATHER, name)
    values = results.Results(done.folder, "Monthly")
    rooms = {}
    for window in values.receivers:
        for room in generate.ROOMS:
            if window.startswith(room.upper()) and values.receivers[window].kind == "Window":
                beam, total = rooms.get(room, (0.0, 0.0))
                rooms[room] = (beam + values.total(results.BEAM, window), total + values.total(results.SOLAR, window))
    return rooms, done.seconds


def compare(folder):
    print("| canopy | west room, beam kWh | total kWh | east room, beam kWh | total kWh | total, % of no canopy "
          "| seconds |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    whole = None
    for number, (name, variant) in enumerate(VARIANTS.items()):
        rooms, seconds = run(name, variant, folder / str(number))
        total = sum(all_ for _, all_ in rooms.values())
        whole = whole or total
        cells = " | ".join(f"{value:,.0f}" for room in generate.ROOMS for value in rooms[room])
        print(f"| {name} | {cells} | {100 * total / whole:.1f} % | {seconds:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Compares glass canopies by the sun in the rooms below.")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/canopy"), metavar="DIR",
                        help="folder for the runs")
    with case_study.replacing(parser.parse_args().output, "canopy") as output:
        compare(output.path)


if __name__ == "__main__":
    main()
