#!/usr/bin/env python3
"""The share of a uniform sky that each face of a model's shading surfaces sees, by rays from random points on it,
beside EnergyPlus's ratio with polygon clipping and with rendering.

    tests/energyplus/sky_by_rays.py model.idf -w weather.epw

Nothing of the renderer is used but the vertices of `gpu_shading check --vertices`. The model must have solar
reflections, so that all shading surfaces are receivers. Only shading surfaces cast here: give it
models whose building is small beside them.
"""

import argparse
import csv
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "scripts"), str(Path(__file__).resolve().parent)]

from output_files import values_of  # noqa: E402
from shading_runs import energyplus  # noqa: E402

RATIO = "Debug Surface Solar Shading Model DifShdgRatioIsoSky"


class Sheet:
    """A plane polygon."""

    def __init__(self, corners):
        self.corners = np.array(corners)
        area = sum(np.cross(a, b) for a, b in zip(self.corners, np.roll(self.corners, -1, 0), strict=True))
        self.normal = area / np.linalg.norm(area)
        self.across = int(np.argmax(abs(self.normal)))  # the axis along which it is projected
        self.along = [axis for axis in range(3) if axis != self.across]
        self.ring = self.corners[:, self.along]

    def contains(self, points):
        """Of points in its plane, by crossings of a ray in the projection."""
        x, y = points[:, self.along].T
        inside = np.zeros(len(points), bool)
        for (x1, y1), (x2, y2) in zip(self.ring, np.roll(self.ring, -1, 0), strict=True):
            if y1 != y2:
                inside ^= ((y1 > y) != (y2 > y)) & (x < (x2 - x1) * (y - y1) / (y2 - y1) + x1)
        return inside

    def random_points(self, count, random):
        low, high = self.ring.min(0), self.ring.max(0)
        found = np.empty((0, 3))
        while len(found) < count:
            points = np.zeros((4 * count, 3))
            points[:, self.along] = low + (high - low) * random.random((4 * count, 2))
            offset = (points - self.corners[0])[:, self.along] @ self.normal[self.along]
            points[:, self.across] = self.corners[0][self.across] - offset / self.normal[self.across]
            found = np.concatenate([found, points[self.contains(points)]])
        return found[:count]

    def stops(self, points, direction):
        falling = self.normal @ direction
        if abs(falling) < 1e-12:
            return np.zeros(len(points), bool)
        distance = (self.corners[0] - points) @ self.normal / falling
        stopped = distance > 1e-6
        stopped[stopped] = self.contains(points[stopped] + distance[stopped, None] * direction)
        return stopped


def seen_sky(sheets, name, side, count, random):
    """(ratio, its standard error) on the side of the normal, or -1: the other; None if it sees no sky by itself.

    EnergyPlus's patches: 6 altitudes x 24 azimuths, weighted by cosines of incidence and of altitude.
    """
    sheet, lit_sum, all_sum, variance = sheets[name], 0.0, 0.0, 0.0
    for altitude in np.radians(np.arange(7.5, 90, 15)):
        for azimuth in np.radians(np.arange(0, 360, 15)):
            direction = np.array([math.cos(altitude) * math.cos(azimuth), math.cos(altitude) * math.sin(azimuth),
                                  math.sin(altitude)])
            weight = side * (sheet.normal @ direction) * math.cos(altitude)
            if weight <= 1e-9:
                continue
            points = sheet.random_points(count, random)
            lit = np.ones(count, bool)
            for other in sheets.values():
                if other is not sheet:
                    lit[lit] = ~other.stops(points[lit], direction)
            lit_sum += weight * lit.mean()
            all_sum += weight
            variance += weight**2 * lit.mean() * (1 - lit.mean()) / count
    return (lit_sum / all_sum, math.sqrt(variance) / all_sum) if all_sum > 0 else None


def shading_surfaces(text):
    """Upper-case names of the detailed ones in an IDF."""
    return {name.strip().upper() for name in re.findall(r"(?i)^\s*Shading:\w+:Detailed,\s*([^,]*),", text, re.M)}


def ratios_of_energyplus(program, model, weather, folder, flags):
    """({face: ratio} on the first day that the model runs, what EnergyPlus warned)."""
    run = energyplus.run(program, model, weather, folder, flags)
    if not run.completed:
        raise SystemExit(f"sky_by_rays: {run.why()}")
    return ({face: values[0] for face, values in values_of(run, RATIO).items()},
            (folder / "eplusout.err").read_text(errors="replace"))


def compare(source, weather, folder, points, flags=(), chosen=None):
    """([(face, by clipping, rendered, by rays, standard error of that)], what EnergyPlus warned with clipping).

    chosen: names of surfaces (default: all).
    """
    text = source.read_text(errors="replace")
    model = folder / "model.idf"
    model.write_text(f"{text}\nOutput:Variable,*,{RATIO},Daily;\nOutput:SQLite,Simple;\n")
    clipped, warned = ratios_of_energyplus(energyplus.official_prefix() / "energyplus", model, weather,
                                           folder / "clipped", list(flags))
    rendered, _ = ratios_of_energyplus(energyplus.patched_prefix() / "energyplus", model, weather, folder / "rendered",
                                       [*flags, "--gpu-shading", "--gpu-shading-lean=off"])
    listed = subprocess.run([energyplus.patched_prefix() / "gpu_shading", "check", model, "--vertices"], check=True,
                            capture_output=True, text=True, env=os.environ | {"GPU_SHADING_LEAN": "off"})
    corners = {}
    for row in csv.DictReader(listed.stdout.splitlines()):
        corners.setdefault(row["surface"], []).append([float(row[f"{axis} [m]"]) for axis in "xyz"])
    sheets = {name: Sheet(corners[name]) for name in sorted(shading_surfaces(text))}
    rows, random = [], np.random.default_rng(1)
    for name in chosen or sheets:
        for side, face in ((1, name), (-1, f"Mir-{name}")):
            seen = seen_sky(sheets, name, side, points, random) if face in clipped else None
            if seen:
                rows.append((face, clipped[face], rendered[face], *seen))
    return rows, warned


def main():
    parser = argparse.ArgumentParser(description="Compares the sky that shading surfaces see with rays.")
    parser.add_argument("model", type=Path)
    parser.add_argument("-w", "--weather", required=True)
    parser.add_argument("--points", type=int, default=1000, help="on each face, for each patch of the sky")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        rows, warned = compare(arguments.model, energyplus.find_weather(arguments.weather), Path(folder),
                               arguments.points)
    print("face,clipped,rendered,by rays,standard error")
    for row in sorted(rows, key=lambda row: -abs(row[1] - row[2])):
        print("{},{:.5f},{:.5f},{:.5f},{:.5f}".format(*row))
    if "Too many figures" in warned:
        print("EnergyPlus warned: Too many figures")


if __name__ == "__main__":
    main()
