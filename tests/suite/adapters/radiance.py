#!/usr/bin/env python3
"""Radiance (pyradiance): direct irradiance by rtrace at Sobol points of each receiver; opaque casters only.

    radiance.py [--points N] SCENE
"""

import os
import subprocess
import tempfile
from pathlib import Path

import adapter
import numpy as np
import points

FOLDER = adapter.REPOSITORY / ".venv" / "radiance" / "pyradiance"
SUN = "void light sun\n0\n0\n3 1e9 1e9 1e9\nsun source disc\n0\n0\n4 {:.12g} {:.12g} {:.12g} 0.001\n"
DIRECT = ["-h", "-I", "-fff", "-ab", "0", "-dt", "0", "-dj", "0", "-dc", "1", "-ds", "0", "-st", "0"]


def call(program, words, folder, data=None):
    environment = {**os.environ, "RAYPATH": f"{folder}:{FOLDER / 'lib'}"}
    return subprocess.run([FOLDER / "bin" / program, *words], cwd=folder, env=environment, check=True, input=data,
                          stdout=subprocess.PIPE).stdout


def tracer_of(triangles):
    text = "void plastic black\n0\n0\n5 0 0 0 0 0\n"
    for number, triangle in enumerate(triangles):
        corners = " ".join(f"{value:.12g}" for value in triangle.ravel())
        text += f"black polygon triangle_{number}\n0\n0\n9 {corners}\n"
    temporary = tempfile.TemporaryDirectory()

    def tracer(direction):
        folder = Path(temporary.name)
        (folder / "scene.rad").write_text(text + SUN.format(*direction))
        (folder / "scene.oct").write_bytes(call("oconv", ["scene.rad"], folder))

        def lit(places, normal):
            rays = np.hstack([places, np.tile(normal, (len(places), 1))]).astype(np.float32)
            light = np.frombuffer(call("rtrace", [*DIRECT, "scene.oct"], folder, rays.tobytes()), np.float32)
            return light[::3] > 0

        return lit

    return tracer


if __name__ == "__main__":
    points.answer("--points", 16384, "this adapter has no glass", tracer_of)
