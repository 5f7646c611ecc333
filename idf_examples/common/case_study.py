"""Runs the variants of a large model for a year and prints their solar radiation as Markdown."""

import argparse
import json
import re
import subprocess
import sys
import time
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from shading_runs import energyplus, output_folder, results
from shading_runs.errors import in_words

OF_RUN = ["heating kWh", "cooling kWh", "seconds", "rendering", "receivers", "casters"]


@dataclass(frozen=True)
class CaseStudy:
    """model_of(variant, is_small) returns a model's text; write_files(variant, is_small, folder) writes the files
    that it needs; group_of(window) returns the column of a window, from its name in upper case.
    """

    name: str
    weather: str
    variants: dict  # {words: variant}
    groups: list
    group_of: callable
    model_of: callable
    write_files: callable = lambda variant, is_small, folder: None


@dataclass(frozen=True)
class Rendered:
    """The counts and seconds that our module reports for a run."""

    receivers: int
    casters: int
    seconds: float


def rendered(run):
    found = re.search(r"(\d+) receivers, (\d+) casters, .* ([\d.]+) s$", run.rendering)
    return Rendered(int(found[1]), int(found[2]), float(found[3]))


def admitted(study, run, variable):
    """kWh through all windows, then through the windows of each group."""
    energies = results.energies(run.folder, variable)
    sums = dict.fromkeys(study.groups, 0.0)
    for window, energy in energies.items():
        sums[study.group_of(window)] += energy
    return [sum(energies.values()), *sums.values()]


def cells_of(study, run):
    did = rendered(run)
    values = [f"{energy:,.0f}" for energy in admitted(study, run, results.SOLAR)]
    values += [f"{sum(results.energies(run.folder, variable).values()):,.0f}"
               for variable in (results.IDEAL_HEATING, results.IDEAL_COOLING)]  # fmt: skip
    return [*values, f"{run.wall:.1f}", f"{did.seconds:.1f}", f"{did.receivers:,}", f"{did.casters:,}"]


def write_model(study, variant, folder, arguments):
    path = folder / f"{study.name}.idf"
    path.write_text("".join(study.model_of(variant, arguments.small)))
    study.write_files(variant, arguments.small, folder)
    return path


def print_row(*cells):
    print(f"| {' | '.join(cells)} |", flush=True)


def print_head(study, *columns):
    print_row(study.name.replace("_", " "), *columns)
    print(f"|---|{'---:|' * len(columns)}")


def take_samples(study, variant, mode, folder, arguments):
    """Wall-clock seconds of sampling in a mode, and the number of directions."""
    path = write_model(study, variant, folder, arguments)
    command = [energyplus.patched_prefix() / "gpu_shading", "sample", path.resolve(),
               "-w", energyplus.find_weather(arguments.weather), "-o", folder / mode, "--mode", mode,
               f"--gpu-shading-device={arguments.device}"]  # fmt: skip
    began = time.monotonic()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=arguments.timeout)
    except subprocess.TimeoutExpired:
        sys.exit(f"{variant}, {mode}: stopped after {arguments.timeout} s")
    seconds = time.monotonic() - began
    if done.returncode != 0:
        sys.exit(f"{variant}, {mode}: {done.stderr.strip()}")
    return seconds, json.loads((folder / mode / "samples.json").read_text())["directions"]


def print_samples(study, arguments, output):
    print_head(study, *(f"{mode}, s (directions)" for mode in arguments.samples))
    for number, (words, variant) in enumerate(study.variants.items()):
        folder = output / str(number)
        folder.mkdir()
        taken = [take_samples(study, variant, mode, folder, arguments) for mode in arguments.samples]
        print_row(words, *(f"{seconds:.1f} ({directions})" for seconds, directions in taken))


def run_variant(study, variant, folder, arguments):
    folder.mkdir()
    path = write_model(study, variant, folder, arguments)
    options = ["--gpu-shading", f"--gpu-shading-device={arguments.device}",
               f"--gpu-shading-update={arguments.update}"]
    return energyplus.run(energyplus.patched_prefix() / "energyplus", path,
                          energyplus.find_weather(arguments.weather), folder / "run", options,
                          timeout=arguments.timeout)  # fmt: skip


def change(value, before):
    return f"{100 * (value / before - 1):+.1f} %" if before > 0 else "-"


def print_changes(study, runs):
    """Prints each variant compared with the first."""
    names = list(study.variants)
    print(f"\nCompared with {names[0]}, with the beam alone in parentheses:\n")
    print_head(study, "all", *study.groups)

    def changes(variable):
        first, *others = [admitted(study, run, variable) for run in runs]
        return [[change(value, before) for value, before in zip(sums, first, strict=True)] for sums in others]

    for words, solar, beam in zip(names[1:], changes(results.SOLAR), changes(results.BEAM), strict=True):
        print_row(words, *(f"{both} ({alone})" for both, alone in zip(solar, beam, strict=True)))


def print_years(study, arguments, output):
    print_head(study, "all kWh", *study.groups, *OF_RUN)
    runs = []
    for number, (words, variant) in enumerate(study.variants.items()):
        run = run_variant(study, variant, output / str(number), arguments)
        if not run.completed or run.severe:
            sys.exit(f"{words}: {run.why()}")
        print_row(words, *cells_of(study, run))
        print(f"{words}: {run.device}", file=sys.stderr, flush=True)
        runs.append(run)
    print_changes(study, runs)


@contextmanager
def replacing(folder, name):
    """An output folder that replaces that of the last study; ends the program if it cannot."""
    try:
        with output_folder.replacing(folder, f"{name}_study") as output:
            yield output
    except (OSError, output_folder.NotOurs) as error:
        sys.exit(f"{name}: {in_words(error)}")


# Variants without shades must get reflected light by the same method.
ALL_LIGHT = ["--gpu-shading-reflections=all"]


def run_year(path, weather, words):
    """Runs a model with our shading in run/ beside it; ends the program if that fails."""
    done = energyplus.run(energyplus.patched_prefix() / "energyplus", path, energyplus.find_weather(weather),
                          path.parent / "run", ["--gpu-shading", *ALL_LIGHT])  # fmt: skip
    if not done.completed:
        sys.exit(f"{words}: {done.why()}")
    return done


def main(study):
    parser = argparse.ArgumentParser(description="Runs each variant for a year and prints a table.")
    parser.add_argument("-o", "--output", type=Path, default=Path("out") / study.name, metavar="DIR",
                        help="folder for the runs (default: %(default)s)")  # fmt: skip
    parser.add_argument("-w", "--weather", default=study.weather, metavar="EPW",
                        help="weather file (default: %(default)s)")  # fmt: skip
    parser.add_argument("--device", default="auto", metavar="NAME", help="as --gpu-shading-device (default: auto)")
    parser.add_argument("--update", default="idf", metavar="HOW", help="as --gpu-shading-update (default: idf)")
    parser.add_argument("--samples", nargs="+", metavar="DETAIL",
                        help="measure the time of sampling (fine, medium, coarse), not of years")  # fmt: skip
    parser.add_argument("--timeout", type=float, metavar="SECONDS", help="time limit for one run (default: none)")
    parser.add_argument("--small", action="store_true", help="run the small model of the same kind")
    arguments = parser.parse_args()
    print_all = print_samples if arguments.samples else print_years
    with replacing(arguments.output, study.name) as output:
        print_all(study, arguments, output.path)
