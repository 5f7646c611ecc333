#!/usr/bin/env python3
"""Runs the office for a year in different surroundings and prints the solar radiation of each window as Markdown.

    study.py [-o DIR]             # the year
    study.py --load [-o DIR]      # seconds to load sails with increasing numbers of triangles
"""

import argparse
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import generate  # noqa: E402
from common import case_study  # noqa: E402
from shading_runs import energyplus, results  # noqa: E402

WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"
VARIANTS = {
    "nothing": (),
    "the town": ("town",),
    "the hills": ("hills",),
    "the town and the hills": ("town", "hills"),
    "the town, the hills and the sail": ("town", "hills", "sail"),
}
SIDES = ("SOUTH", "EAST", "NORTH", "WEST")
TRIANGLES = (0, 1_000, 10_000, 100_352)


def year(folder):
    print("| surroundings | south, kWh | east | north | west | all | % of none | seconds |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|")
    whole = None
    for number, (name, parts) in enumerate(VARIANTS.items()):
        path = generate.write(folder / str(number), parts)
        done = case_study.run_year(path, WEATHER, name)
        values = results.Results(done.folder, "Monthly")
        windows = [values.total(results.SOLAR, f"{side} WINDOW") for side in SIDES]
        whole = whole or sum(windows)
        cells = " | ".join(f"{value:,.0f}" for value in (*windows, sum(windows)))
        print(f"| {name} | {cells} | {100 * sum(windows) / whole:.1f} % | {done.seconds:.1f} |", flush=True)


def load(folder, times=5):
    """Times `gpu_shading check`, which reads the model twice and runs EnergyPlus up to its shading calculation."""
    print("| triangles | seconds |")
    print("|---:|---:|")
    for triangles in TRIANGLES:
        path = generate.write(folder / f"load {triangles}", ("sail",) if triangles else (), triangles)
        took = []
        for _ in range(times):
            start = time.perf_counter()
            subprocess.run([energyplus.patched_prefix() / "gpu_shading", "check", path], check=True,
                           stdout=subprocess.DEVNULL)
            took.append(time.perf_counter() - start)
        print(f"| {triangles:,} | {median(took):.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Compares surroundings of an office by its solar radiation.")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/site_context_study"), metavar="DIR",
                        help="folder for the runs")
    parser.add_argument("--load", action="store_true", help="measure the time to load meshes instead")
    arguments = parser.parse_args()
    with case_study.replacing(arguments.output, "site_context") as output:
        (load if arguments.load else year)(output.path)


if __name__ == "__main__":
    main()
