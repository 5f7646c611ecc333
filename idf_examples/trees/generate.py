#!/usr/bin/env python3
"""Writes trees_mesh.idf, the model with the oak's crown as a closed mesh, and its mesh, oak.obj.

    generate.py [FOLDER]
"""

import argparse
import math
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
OAK = re.compile(r"GPUShading:Tree, Oak,[^;]*;\n")
# A spreading crown: radius and height of its rings, from the underside to the top.
RINGS = ((0.55, 0.08), (0.9, 0.2), (1.0, 0.42), (0.85, 0.7), (0.5, 0.92))
SIDES = 12


def crown():
    """Wavefront OBJ, closed: a point below, rings, and a point above."""
    points = [(0, 0, 0)]
    for radius, height in RINGS:
        for side in range(SIDES):
            angle = 2 * math.pi * side / SIDES
            # Three boughs.
            reach = radius * (0.88 + 0.12 * math.cos(3 * angle))
            points.append((reach * math.cos(angle), reach * math.sin(angle), height))
    points.append((0, 0, 1))
    last = len(points)
    faces = []
    for side in range(SIDES):
        here, there = 2 + side, 2 + (side + 1) % SIDES
        faces.append((1, there, here))
        for ring in range(len(RINGS) - 1):
            a, b = here + ring * SIDES, there + ring * SIDES
            faces += [(a, b, b + SIDES), (a, b + SIDES, a + SIDES)]
        faces.append((here + (len(RINGS) - 1) * SIDES, there + (len(RINGS) - 1) * SIDES, last))
    lines = [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in points] + [f"f {a} {b} {c}" for a, b, c in faces]
    return "\n".join(lines) + "\n"


def model():
    text = (HERE / "trees.idf").read_text(encoding="utf-8")
    mesh = ("GPUShading:Geometry, Oak Crown, oak.obj, m, Z;\n"
            "GPUShading:Tree, Oak, 9, -6, 0, 11, 8, 2, Mesh, 0.5, Deciduous, , 0.9, 0.15, , , , Oak Crown*;\n")
    return OAK.sub(mesh, text)


def write(folder):
    contents = {"trees_mesh.idf": model(), "oak.obj": crown()}
    if folder.resolve() != HERE:
        contents["trees.geojson"] = (HERE / "trees.geojson").read_text(encoding="utf-8")
    for name in contents:
        if (folder / name).exists():
            sys.exit(f"{folder / name} exists; expected a folder without it")
    for name, text in contents.items():
        with open(folder / name, "x", encoding="utf-8") as file:
            file.write(text)


def main():
    parser = argparse.ArgumentParser(description="Writes the model whose oak has a crown of a mesh.")
    parser.add_argument("folder", nargs="?", type=Path, default=Path())
    write(parser.parse_args().folder)


if __name__ == "__main__":
    main()
