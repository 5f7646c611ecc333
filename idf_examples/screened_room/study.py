#!/usr/bin/env python3
"""Runs the room for a year with each screen, facing three ways, and prints its solar radiation as Markdown.

    study.py [-o DIR]
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "scripts")]

import generate  # noqa: E402
from shading_runs import energyplus, output_folder, results  # noqa: E402

WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"
# As in the table; the others are compared with the first two.
SCREENS = {
    "none": "none",
    "schedule": "schedule, 0.5",
    "small holes": "6.35 mm holes",
    "large holes": "25.4 mm holes",
    "gradient": "gradient",
}


def run(facing, screen, folder):
    folder.mkdir()
    path = folder / "screened_room.idf"
    path.write_text("".join(generate.model(facing, screen)))
    if screen == "gradient":
        generate.write_image(folder / generate.IMAGE)
    done = energyplus.run(energyplus.patched_prefix() / "energyplus", path, energyplus.find_weather(WEATHER),
                          folder / "run", ["--gpu-shading"])
    if not done.completed:
        sys.exit(f"{facing}, {screen}: {done.why()}")
    values = results.Results(done.folder, "Monthly")
    return (values.total(results.BEAM), values.total(results.SOLAR)), done.seconds


def compare(folder):
    print("| facing | screen | beam kWh | % of none | % of schedule | total kWh | % of none | % of schedule "
          "| seconds |")
    print("|---|---|---:|---:|---:|---:|---:|---:|---:|")
    for facing in generate.AZIMUTHS:
        found = []
        for screen, words in SCREENS.items():
            sun, seconds = run(facing, screen, folder / f"{facing} {screen}".replace(" ", "_"))
            found.append(sun)
            cells = [f"{facing} | {words}"]
            for part in (0, 1):
                cells.append(f"{sun[part]:,.0f}")
                cells += [f"{100 * sun[part] / other[part]:.1f} %" if len(found) > number else ""
                          for number, other in enumerate((found[0], found[min(1, len(found) - 1)]))]
            print(f"| {' | '.join(cells)} | {seconds:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Compares perforated screens by the sun in the room behind them.")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/screened_room"), metavar="DIR",
                        help="for the runs")  # fmt: skip
    try:
        with output_folder.replacing(parser.parse_args().output, "screened_room_study") as output:
            compare(output.path)
    except output_folder.NotOurs as error:
        sys.exit(f"screened_room: {error}")


if __name__ == "__main__":
    main()
