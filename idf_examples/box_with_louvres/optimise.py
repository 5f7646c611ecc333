#!/usr/bin/env python3
"""Searches depth and tilt of ten blades before a window for little cooling and much daylight.

    optimise.py VARIANTS [DIR]

Each generation of the search (NSGA-II of platypus-opt) is a study in DIR, by default ./study, until there are so many
variants. A search that was killed goes through what is there without running it again. Prints the best of all variants,
and draws DIR/trade.png.
"""

import random
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from dask.distributed import Client

import gpu_shading
from gpu_shading import _files

try:
    from platypus import NSGAII, Problem, Real
except ImportError:
    sys.exit("optimise.py: platypus-opt is missing: pip install platypus-opt==1.4.1")

MODEL = Path(__file__).with_name("box_with_louvres.idf")
WEATHER = gpu_shading.prefix() / "WeatherData" / "USA_CO_Golden-NREL.724666_TMY3.epw"
OUTPUT = "Daylighting Reference Point 1 Illuminance"
COOLING, DAYLIGHT = "Cooling District Cooling [kWh]", f"{OUTPUT}, BOX DAYLIGHT [lux]"
# A sensor in the middle of the room, at 0.8 m.
SENSOR = """
Lights,Lamps,Box,Always On,LightingLevel,300;
Schedule:Constant,Always On,,1;
Daylighting:ReferencePoint,Sensor,Box,3,3,0.8;
Daylighting:Controls,Box Daylight,Box,SplitFlux,,Continuous,0.3,0.2,,,Sensor,180,22,,Sensor,1,500;
"""


def case(depth, tilt):
    """Ten blades before the window; a tilt lowers their outer edges."""
    out, drop = depth * np.cos(np.radians(tilt)), depth * np.sin(np.radians(tilt))
    blades = "".join(
        f"Shading:Building:Detailed,Blade {number},,4,1.5,-0.05,{z:.3f},1.5,{-0.05 - out:.4f},{z - drop:.4f},"
        f"4.5,{-0.05 - out:.4f},{z - drop:.4f},4.5,-0.05,{z:.3f};\n"
        for number, z in enumerate(np.linspace(2.8, 0.8, 10, endpoint=False)))
    return gpu_shading.Case(MODEL, WEATHER, f"{depth:.3f} m, {tilt:.1f} deg",
                            remove=("Shading:Building:Detailed",), objects=SENSOR + blades)


def search(count, folder):
    """The rows of the table of all variants that were tried."""
    with Client(threads_per_worker=1) as client:
        cases = {}

        def evaluate(variables):
            """Of a generation; what is in the folder already is not run again."""
            asked = [case(round(depth, 3), round(tilt, 1)) for depth, tilt in variables]
            cases.update((each.variant, each) for each in asked)
            new = {each.variant: each for each in asked}.values()
            rows = gpu_shading.Study(new, folder, outputs=[OUTPUT], keep="nothing", client=client).run()
            found = {row["variant"]: (row.get(COOLING, 0.0), -row[DAYLIGHT]) for row in rows}
            return [found[each.variant] for each in asked]

        class Generation:
            def evaluate_all(self, jobs, **_):
                for job, objectives in zip(jobs, evaluate([job.solution.variables for job in jobs]), strict=True):
                    job.solution.objectives[:] = objectives
                    job.solution.evaluated = True
                return jobs

        problem = Problem(2, 2)
        problem.types[:] = [Real(0.02, 0.30), Real(0, 80)]
        NSGAII(problem, population_size=20, evaluator=Generation()).run(lambda _: len(cases) >= count)
        return gpu_shading.Study(cases.values(), folder, outputs=[OUTPUT], keep="nothing", client=client).run()


def draw(cooling, daylight, front, file):
    plt.scatter(daylight, cooling, 8, "silver")
    plt.plot(daylight[front], cooling[front], "o-", markersize=3)
    plt.xlabel("mean illuminance of the sensor, lux")
    plt.ylabel("cooling of the year, kWh")
    with _files.staged(file) as temporary:
        plt.savefig(temporary, dpi=90)


def main(count, folder="study"):
    random.seed(1)
    rows = search(int(count), Path(folder))
    cooling, daylight = (np.array([row[name] for row in rows]) for name in (COOLING, DAYLIGHT))
    order = np.argsort(cooling)
    front = [place for rank, place in enumerate(order) if daylight[place] > daylight[order[:rank]].max(initial=0)]
    print(f"{len(rows)} variants, {len(front)} of them best")
    for place in front[:: -(-len(front) // 5)]:
        print(f"{cooling[place]:5.0f} kWh {daylight[place]:6.0f} lux  {rows[place]['variant']}")
    draw(cooling, daylight, front, Path(folder) / "trade.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
