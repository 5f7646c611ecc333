#!/usr/bin/env python3
"""What solar radiation enters each shared model, with EnergyPlus's reflected light and with all of the light.

    light_balance.py [--day MM-DD] [MODEL ...]

A line for each model, of a day of its weather file (or of its design days, with --day design): kWh through all windows
of the beam and of diffuse light, and what a window gets from the ground, kWh/m2, in the mean, by stock EnergyPlus, by
--gpu-shading-reflections=energyplus and by =all. Checked, at each timestep of each run: total incident radiation is
beam, sky and ground, except where EnergyPlus reflects by itself; and models without objects of this module run as by
=energyplus with =auto, to the digit.
"""

import argparse
import re
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "energyplus")]

import test_models  # noqa: E402
from output_files import differing, snapshot, values_of  # noqa: E402
from reflecting_scenes import INCIDENT, PARTS  # noqa: E402
from shading_runs import energyplus, input_file  # noqa: E402

TRANSMITTED = [f"Surface Window Transmitted {kind} Solar Radiation Rate" for kind in ("Beam", "Diffuse")]
OUTPUTS = "".join(f"Output:Variable,*,{name},Hourly;\n" for name in (
    *TRANSMITTED, INCIDENT.format(""), *map(INCIDENT.format, PARTS))) + "Output:SQLite,Simple;\n"
WAYS = {"stock": None, "energyplus": "energyplus", "all": "all", "auto": "auto"}


def prepared(path, day, folder):
    text = path.read_text(errors="replace")
    text = re.sub(r"(?im)^\s*Output:(Variable|Meter|SQLite|Table:[A-Za-z]+)\s*,[^;]*;", "", text)
    path = folder / path.name
    path.write_text(text + "\n" + OUTPUTS)
    if day != "design":
        model = input_file.read(path)
        for place, value in zip(test_models.RUN_PERIOD_FIELDS, (*day.split("-"), *day.split("-")), strict=True):
            model.set_field("RunPeriod", place, str(int(value)))
        model.write(path)
    return path


def check_sums(run, name):
    total, parts = values_of(run, INCIDENT.format("")), [values_of(run, INCIDENT.format(part)) for part in PARTS]
    worst = max((abs(value - sum(part[surface][step] for part in parts)) for surface, values in total.items()
                 for step, value in enumerate(values) if surface in parts[2]), default=0.0)
    if worst > 1e-6:
        print(f"{name}: total incident radiation is off by {worst:.2g} W/m2")


def sums(run):
    beams, diffuse = (values_of(run, name) for name in TRANSMITTED)
    ground = values_of(run, INCIDENT.format(PARTS[2]))
    of_windows = [sum(ground[window]) / 1000 for window in beams if window in ground]  # not of those indoors
    return (sum(map(sum, beams.values())) / 1000, sum(map(sum, diffuse.values())) / 1000,
            sum(of_windows) / max(1, len(of_windows)))


def balance(name, weather, flags, day, folder):
    path = prepared(test_models.MODELS / name, day, folder)
    runs = {}
    for way, option in WAYS.items():
        options = ["-D"] if day == "design" else []
        options += (flags[0].split() if flags else [])
        prefix = energyplus.official_prefix()
        if option:
            prefix = energyplus.patched_prefix()
            options += ["--gpu-shading", f"--gpu-shading-reflections={option}"]
        runs[way] = energyplus.run(prefix / "energyplus", path, weather, folder / way, options)
        if not runs[way].completed:
            print(f"{name}: {way}: {runs[way].why()}")
            continue
        if way == "all" or "WithReflections" not in path.read_text():
            check_sums(runs[way], f"{name}, {way}")
        if way != "auto":
            beam, diffuse, ground = sums(runs[way])
            print(f"{name if way == 'stock' else '':46} {way:10} {beam:10.2f} {diffuse:10.2f} {ground:10.3f}",
                  flush=True)
    if runs["energyplus"].completed and runs["auto"].completed:
        energy, auto = (snapshot(runs[way].folder) for way in ("energyplus", "auto"))
        other = [file for file in differing(energy, auto) if file.endswith((".eso", ".mtr"))]
        print(f"{'':46} auto is {'not ' if other else ''}as energyplus")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--day", default="03-21")
    parser.add_argument("models", nargs="*")
    arguments = parser.parse_args()
    rows = [row.split("\t") for row in (test_models.MODELS / "INDEX.tsv").read_text().splitlines() if row]
    print(f"{'model':46} {'':10} {'beam kWh':>10} {'diffuse':>10} {'ground/m2':>10}")
    for name, weather, period, *flags in rows:
        if arguments.models and not any(each in name for each in arguments.models):
            continue
        with tempfile.TemporaryDirectory() as folder:
            day = "design" if period == "dd" else arguments.day  # models that have design days alone
            balance(name, energyplus.find_weather(weather), flags, day, Path(folder))


if __name__ == "__main__":
    main()
