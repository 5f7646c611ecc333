#!/usr/bin/env python3
"""CPU time that gpu_shading modules takes for a field of 2,000 modules of 60 cells, per timestep with the sun up.

    tests/bench/pv_modules.py [ROWS [MODULES]]     rows of so many modules; 40 of 50 when left out

Rows face south, tilted by 20 degrees and 2.6 m apart, with a pole in front of every tenth module. Runs of one day and
of five days are compared, so that the start of EnergyPlus does not count. In June few modules are partly shaded, in
December most, by the row before.
"""

import csv
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

from processor_time import spent_by_children  # noqa: E402
from shading_runs import energyplus  # noqa: E402

EXAMPLE = energyplus.REPOSITORY / "idf_examples" / "pv_roof" / "pv_roof.idf"
WEATHER = "USA_CO_Golden-NREL.724666_TMY3.epw"


def model(rows, modules):
    text = EXAMPLE.read_text().partition("! The parapet")[0]
    deep, high = 1.66 * math.cos(math.radians(20)), 1.66 * math.sin(math.radians(20))
    width = 1.02 * modules
    for row in range(rows):
        y = 20 + 2.6 * row
        text += (f"Shading:Building:Detailed,Row {row},,4, 0,{y + deep},{1 + high}, 0,{y},1, {width},{y},1, "
                 f"{width},{y + deep},{1 + high};\n")
        for x in range(0, modules, 10):
            text += (f"Shading:Building:Detailed,Pole {row} {x},,4, {x + 0.4},{y - 0.3},3, {x + 0.4},{y - 0.3},0, "
                     f"{x + 0.5},{y - 0.3},0, {x + 0.5},{y - 0.3},3;\n")
    return text + "GPUShading:PVModules,Modules,Row *,1.0,1.65;\n"


def measure(folder, first, last):
    """(CPU seconds, timesteps, share of bypass diodes with shade)"""
    before = spent_by_children()
    environment = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    subprocess.run([energyplus.patched_prefix() / "gpu_shading", "modules", folder / "field.idf", "-w",
                    energyplus.find_weather(WEATHER), "--from", first, "--to", last, "-o", folder / "out"],
                   check=True, capture_output=True, env=environment)
    seconds = spent_by_children() - before
    with open(folder / "out" / "times.csv", encoding="utf-8") as lines:
        times = sum(1 for _ in lines) - 1
    with open(folder / "out" / "strings.csv", newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    partly = sum(int(row["shaded blocks"]) for row in rows) / max(sum(int(row["blocks"]) for row in rows), 1)
    return seconds, times, partly


def main():
    rows, modules = (int(each) for each in (sys.argv[1:] + ["40", "50"][len(sys.argv) - 1:])[:2])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "field.idf").write_text(model(rows, modules), encoding="utf-8")
        for month in ("06", "12"):
            short, few, _ = measure(folder, f"{month}-18", f"{month}-18")
            long, many, partly = measure(folder, f"{month}-18", f"{month}-22")
            each = 1000 * (long - short) / (many - few)
            print(f"{rows * modules} modules, month {month}: {each:.0f} ms of CPU time per timestep, "
                  f"{partly:.0%} of bypass diodes with shade; {short:.1f} s for one day")


if __name__ == "__main__":
    main()
