#!/usr/bin/env python3
"""CPU seconds of a year with --gpu-shading-reflections=all over those of the year with =energyplus.

    reflected_cost.py [--repeat N] [--stock] [SCENE ...]

South office, courtyard, and the box with 20, 100 and 1,000 louvres before one window. The runs of a row follow each
other, and each figure is a median. --stock: also stock EnergyPlus with its own solar reflections.
"""

import argparse
import re
import statistics
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("scripts", "idf_examples/box_with_louvres")]

import generate  # noqa: E402
from processor_time import spent_by_children  # noqa: E402
from shading_runs import energyplus  # noqa: E402

WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"
SCENES = {
    "south office": lambda: (ROOT / "idf_examples/south_office/south_office.idf").read_text(encoding="utf-8"),
    "courtyard": lambda: (ROOT / "idf_examples/courtyard/courtyard.idf").read_text(encoding="utf-8"),
    **{f"{count:,} louvres": lambda count=count: generate.model(count) for count in (20, 100, 1000)},
}


def seconds(prefix, path, folder, options):
    """Of the processors, by EnergyPlus and what it starts."""
    before = spent_by_children()
    done = energyplus.run(prefix / "energyplus", path, energyplus.find_weather(WEATHER), folder, options)
    if not done.completed:
        raise SystemExit(f"reflected_cost: {path.stem}: {done.why()}")
    return spent_by_children() - before


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--stock", action="store_true")
    parser.add_argument("scenes", nargs="*", default=[*SCENES])
    arguments = parser.parse_args()
    ours = energyplus.patched_prefix()
    flags = ["--gpu-shading", "--gpu-shading-device=cpu"]
    print(f"{'':16} {'energyplus':>10} {'all':>8} {'ratio':>6}" + (f" {'stock, own':>10}" if arguments.stock else ""))
    with tempfile.TemporaryDirectory() as name:
        for scene in arguments.scenes:
            plain, reflecting = Path(name) / "plain.idf", Path(name) / "reflecting.idf"
            text = SCENES[scene]()
            plain.write_text(text, encoding="utf-8")
            reflecting.write_text(re.sub(r"(Full\w*Exterior),", r"\1WithReflections,", text), encoding="utf-8")
            rows = []
            for repeat in range(arguments.repeat):
                folder = Path(name) / f"{scene} {repeat}"
                row = [seconds(ours, plain, folder / way, [*flags, f"--gpu-shading-reflections={way}"])
                       for way in ("energyplus", "all")]
                if arguments.stock:
                    row.append(seconds(energyplus.official_prefix(), reflecting, folder / "stock", []))
                rows.append(row)
            before, after, *stock = map(statistics.median, zip(*rows, strict=True))
            ratio = statistics.median(row[1] / row[0] for row in rows)
            print(f"{scene:16} {before:10.2f} {after:8.2f} {ratio:6.2f}" + "".join(f" {each:10.2f}" for each in stock),
                  flush=True)


if __name__ == "__main__":
    main()
