#!/usr/bin/env python3
"""Radiance (pyradiance): direct irradiance by rtrace at Sobol points of each receiver; opaque casters only.

    radiance.py [--points N] SCENE
"""

import argparse
import os
import subprocess
import tempfile
from pathlib import Path

import adapter
import numpy as np
from exact import towards
from points import points_of, triangles_of

FOLDER = adapter.REPOSITORY / ".venv" / "radiance" / "pyradiance"
LIFT = 1e-4  # m: a point is this far before its receiver
SUN = "void light sun\n0\n0\n3 1e9 1e9 1e9\nsun source disc\n0\n0\n4 {:.12g} {:.12g} {:.12g} 0.001\n"
DIRECT = ["-h", "-I", "-fff", "-ab", "0", "-dt", "0", "-dj", "0", "-dc", "1", "-ds", "0", "-st", "0"]


def call(program, words, folder, data=None):
    environment = {**os.environ, "RAYPATH": f"{folder}:{FOLDER / 'lib'}"}
    return subprocess.run([FOLDER / "bin" / program, *words], cwd=folder, env=environment, check=True, input=data,
                          stdout=subprocess.PIPE).stdout


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--points", type=int, default=16384, help="a power of 2")
    parser.add_argument("scene")
    arguments = parser.parse_args()
    surfaces, suns = adapter.read(arguments.scene)
    if any(surface.transmittance > 0 for surface in surfaces):
        adapter.not_supported("this adapter has no glass")
    receivers = [surface for surface in surfaces if surface.receives]
    origin = receivers[0].rings[0][0]  # rtrace reads single precision
    text = "void plastic black\n0\n0\n5 0 0 0 0 0\n"
    for number, triangle in enumerate(part for surface in surfaces if surface.casts for part in triangles_of(surface)):
        corners = " ".join(f"{value:.12g}" for value in (triangle - origin).ravel())
        text += f"black polygon triangle_{number}\n0\n0\n9 {corners}\n"
    found = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for sun in suns:
            direction = towards(sun["azimuth"], sun["altitude"])
            (folder / "scene.rad").write_text(text + SUN.format(*direction))
            (folder / "scene.oct").write_bytes(call("oconv", ["scene.rad"], folder))
            values = {}
            for surface in receivers:
                cosine = direction @ surface.normal
                values[surface.name] = 0.0
                if cosine > 0:
                    points = points_of(triangles_of(surface), arguments.points) - origin + LIFT * surface.normal
                    rays = np.hstack([points, np.tile(surface.normal, (len(points), 1))]).astype(np.float32)
                    light = np.frombuffer(call("rtrace", [*DIRECT, "scene.oct"], folder, rays.tobytes()), np.float32)
                    values[surface.name] = np.mean(light[::3] > 0)
            found.append(values)
    adapter.answer(found)


if __name__ == "__main__":
    main()
