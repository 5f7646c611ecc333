#!/usr/bin/env python3
"""Runs the room for a year with each screen, facing three ways, and prints its sun and its energy as Markdown.

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
# As in the table; the others are compared with the first two.
SCREENS = {
    "none": "none",
    "schedule": "schedule, 0.5",
    "small holes": "6.35 mm holes",
    "large holes": "25.4 mm holes",
    "gradient": "gradient",
}


# Of a year, in kWh.
SUN = (results.BEAM, results.SOLAR)
ENERGY = (results.LIGHTS, results.HEATING, results.COOLING)


def run(facing, screen, folder):
    """(totals by variable, seconds)."""
    folder.mkdir()
    path = folder / "screened_room.idf"
    path.write_text("".join(generate.model(facing, screen)))
    if screen == "gradient":
        generate.write_image(folder / generate.IMAGE)
    done = case_study.run_year(path, WEATHER, f"{facing}, {screen}")
    values = results.Results(done.folder, "Monthly")
    return {variable: values.total(variable) for variable in (*SUN, *ENERGY)}, done.seconds


def print_sun(found):
    print("| facing | screen | beam kWh | % of none | % of schedule | total kWh | % of none | % of schedule "
          "| seconds |")
    print("|---|---|---:|---:|---:|---:|---:|---:|---:|")
    for (facing, screen), (totals, seconds) in found.items():
        cells = [facing, SCREENS[screen]]
        for variable in SUN:
            cells.append(f"{totals[variable]:,.0f}")
            for other in ("none", "schedule"):
                known = list(SCREENS).index(other) <= list(SCREENS).index(screen)
                share = 100 * totals[variable] / found[facing, other][0][variable]
                cells.append(f"{share:.1f} %" if known else "")
        print(f"| {' | '.join(cells)} | {seconds:.1f} |")


def print_energy(found):
    print("| facing | screen | solar kWh | lights kWh | heating kWh | cooling kWh |")
    print("|---|---|---:|---:|---:|---:|")
    for (facing, screen), (totals, _) in found.items():
        amounts = " | ".join(f"{totals[variable]:,.0f}" for variable in (results.SOLAR, *ENERGY))
        print(f"| {facing} | {SCREENS[screen]} | {amounts} |")


def compare(folder):
    found = {}
    for facing in generate.AZIMUTHS:
        for screen in SCREENS:
            found[facing, screen] = run(facing, screen, folder / f"{facing} {screen}".replace(" ", "_"))
            print(f"{facing}, {screen}: {found[facing, screen][1]:.1f} s", file=sys.stderr)
    print_sun(found)
    print()
    print_energy(found)


def main():
    parser = argparse.ArgumentParser(description="Compares perforated screens by the sun in the room behind them.")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/screened_room"), metavar="DIR",
                        help="folder for the runs")  # fmt: skip
    with case_study.replacing(parser.parse_args().output, "screened_room") as output:
        compare(output.path)


if __name__ == "__main__":
    main()
