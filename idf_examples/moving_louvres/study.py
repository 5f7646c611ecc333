#!/usr/bin/env python3
"""Runs the box for a year with its louvres at fixed positions and moving, and prints sun, energy and time as Markdown.

    study.py [--louvres N] [-o DIR]
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import generate  # noqa: E402
from common import case_study, idf  # noqa: E402
from shading_runs import results  # noqa: E402

WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"
# In words: control, position.
VARIANTS = {
    "without object": ("none", 0),
    "fixed at 0": ("fixed", 0),
    "fixed at 20": ("fixed", 20),
    "fixed at 40": ("fixed", 40),
    "fixed at 60": ("fixed", 60),
    "BlockBeam": ("block", 0),
    "BlockBeam in summer": ("summer", 0),
    "TrackSun": ("track", 0),
}
OUTPUTS = idf.SOLAR_OUTPUTS + "".join(
    f"Output:Variable,*,{variable},Monthly;\n" for variable in (results.HEATING, results.COOLING))
ENERGY = (results.BEAM, results.SOLAR, results.HEATING, results.COOLING)


def compare(count, folder):
    print("| louvres | beam kWh | solar kWh | heating kWh | cooling kWh | both kWh | seconds |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    for words, (control, position) in VARIANTS.items():
        place = folder / words.replace(" ", "_")
        place.mkdir()
        path = place / "moving_louvres.idf"
        path.write_text(generate.model(count, control, position) + OUTPUTS)
        done = case_study.run_year(path, WEATHER, words)
        values = results.Results(done.folder, "Monthly")
        totals = [values.total(variable) for variable in ENERGY]
        totals.append(sum(totals[2:]))
        amounts = " | ".join(f"{total:,.0f}" for total in totals)
        print(f"| {words} | {amounts} | {done.seconds:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Compares moving louvres with fixed ones.")
    parser.add_argument("--louvres", type=int, default=generate.ROWS, metavar="N")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/moving_louvres"), metavar="DIR",
                        help="folder for the runs")  # fmt: skip
    chosen = parser.parse_args()
    with case_study.replacing(chosen.output, "moving_louvres") as output:
        compare(chosen.louvres, output.path)


if __name__ == "__main__":
    main()
