#!/usr/bin/env python3
"""EnergyPlus: a model of the scene, its suns as design days at latitude 40.

    energyplus.py [--program FILE] [--algorithm NAME] [--method PolygonClipping|PixelCounting] [--flags "..."] SCENE

`--program`: by default the official EnergyPlus. `--algorithm`: of polygon clipping. `--flags`: of this module, with its
program. `--model`: print the model instead of running it.
"""

import argparse
import os
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

import adapter
import numpy as np

sys.path.insert(0, str(adapter.REPOSITORY / "tests" / "energyplus"))

from eso_file import EsoFile  # noqa: E402
from shading_runs import energyplus  # noqa: E402

MOST_VERTICES_OF_A_WINDOW = 4
HEAD = """\
SimulationControl,No,No,No,Yes,No;
ShadowCalculation,{method},Timestep,1,15000,{algorithm},512;
Building,Suite,0,Country,0.04,0.4,FullExterior,25,1;
Timestep,4;
Site:Location,Suite,40,-105,-7,0;
GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;
Material,Board,Rough,0.2,0.5,1400,1000;
WindowMaterial:SimpleGlazingSystem,Glazing,1.4,0.6;
Construction,Wall,Board;
Construction,Window,Glazing;
Output:Variable,*,Surface Outside Face Sunlit Fraction,Timestep;
"""
DAY = ("SizingPeriod:DesignDay,Day {0} {1},{0},{1},SummerDesignDay,25,0,DefaultMultipliers,,WetBulb,12,,,,,101325,"
       "2,180,No,No,No,ASHRAEClearSky,,,,,1.0;\n")


def vertices(ring):
    return ",".join(["", str(len(ring)), *(f"{value!r}" for point in ring.tolist() for value in point)]) + ";\n"


def wall_of(window, surfaces):
    """The wall that has a hole where this receiver is."""
    for wall in surfaces:
        for hole in wall.rings[1:]:
            apart = hole.mean(axis=0) - window.rings[0].mean(axis=0)
            if len(hole) == len(window.rings[0]) and np.abs(apart).max() < 1e-9:
                return wall
    return None


def receiver_text(surface, surfaces, number):
    if len(surface.rings) == 1 and (wall := wall_of(surface, surfaces)):
        if len(surface.rings[0]) > MOST_VERTICES_OF_A_WINDOW:
            adapter.not_supported("EnergyPlus has no windows of more than four vertices")
        return (f"FenestrationSurface:Detailed,{surface.name},Window,Window,{wall.name},,,,1"
                + vertices(surface.rings[0]))
    tilt = np.degrees(np.arccos(surface.normal[2]))
    kind = "Roof" if tilt < 60 else "Wall"
    return (f"Zone,Zone {number},0,0,0,0,1,1,3,3000;\n"
            # A zone with a window needs another surface, and air and mass. This one has no sun, and casts no shadow.
            f"BuildingSurface:Detailed,Floor {number},Floor,Wall,Zone {number},,Adiabatic,,NoSun,NoWind,,"
            "4,0,0,0,0,90,0,90,90,0,90,0,0;\n"
            f"BuildingSurface:Detailed,{surface.name},{kind},Wall,Zone {number},,Outdoors,,SunExposed,NoWind,"
            + vertices(surface.rings[0]))


def model_of(surfaces, suns, method, algorithm):
    text = HEAD.format(method=method, algorithm=algorithm)
    text += "".join(DAY.format(*day) for day in sorted({tuple(map(int, sun["time"][:5].split("-"))) for sun in suns}))
    for number, surface in enumerate(surfaces):
        if surface.receives:
            windows = [other for other in surfaces
                       if other.receives and other is not surface and wall_of(other, [surface])]
            if len(windows) < len(surface.rings) - 1:
                adapter.not_supported("EnergyPlus has no holes in surfaces other than windows")
            text += receiver_text(surface, surfaces, number)
        if surface.casts:
            if len(surface.rings) > 1:
                adapter.not_supported("EnergyPlus has no holes in shading surfaces")
            schedule = ""
            if surface.transmittance > 0.0:
                schedule = f"Share {number}"
                text += f"Schedule:Constant,{schedule},,{surface.transmittance!r};\n"
            text += f"Shading:Building:Detailed,Caster {number},{schedule}" + vertices(surface.rings[0])
    return text


def time_of(sun):
    """As eplusout.eso has it: (month, day, hour from 1, end of the timestep)."""
    date, clock = sun["time"].split()
    hour, minute = map(int, clock.split(":"))
    return (*map(int, date.split("-")), hour + 1, minute) if minute else (*map(int, date.split("-")), hour, 60)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", type=Path, default=energyplus.official_prefix() / "energyplus")
    parser.add_argument("--algorithm", default="SutherlandHodgman")
    parser.add_argument("--method", default="PolygonClipping")
    parser.add_argument("--flags", default="")
    parser.add_argument("--model", action="store_true")
    parser.add_argument("scene")
    arguments = parser.parse_args()
    surfaces, suns = adapter.read(arguments.scene)
    text = model_of(surfaces, suns, arguments.method, arguments.algorithm)
    if arguments.model:
        print(text)
        return
    with tempfile.TemporaryDirectory() as name:
        model = Path(name) / "model.idf"
        model.write_text(text, encoding="utf-8")
        done = subprocess.run([arguments.program, *shlex.split(arguments.flags), "-D", "-d", name, model],
                              capture_output=True, text=True, check=False,
                              env={**os.environ, "GPU_SHADING_QUIET": "1"} if arguments.flags else None)
        error = Path(name) / "eplusout.err"
        if done.returncode != 0:
            said = [line for line in error.read_text().splitlines() if "Severe" in line or "Fatal" in line]
            raise SystemExit(said[0] if said else done.stderr)
        found = EsoFile(Path(name) / "eplusout.eso", "TimeStep").values
        output = "Surface Outside Face Sunlit Fraction"
        adapter.answer({surface.name: found[output, surface.name.upper()][time_of(sun)]
                        for surface in surfaces if surface.receives} for sun in suns)


if __name__ == "__main__":
    main()
