#!/usr/bin/env python3
"""Embree (embreex): rays from Sobol points of each receiver; opaque casters only.

    embree.py [--rays N] SCENE
"""

import argparse

import adapter
import numpy as np
import shapely
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
from exact import axes_of, towards
from scipy.stats import qmc

LIFT = 1e-4  # m: a ray begins this far before its receiver


def triangles_of(surface):
    """Of shape (n, 3, 3)."""
    axes = axes_of(surface)
    origin = surface.rings[0][0]
    rings = [(ring - origin) @ axes.T for ring in surface.rings]
    parts = shapely.constrained_delaunay_triangles(shapely.Polygon(rings[0], rings[1:])).geoms
    return np.array([origin + np.array(part.exterior.coords)[:3] @ axes for part in parts])


def points_of(triangles, count):
    """Spread by area."""
    areas = 0.5 * np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    up_to = np.concatenate([[0.0], np.cumsum(areas) / areas.sum()])
    u, v = qmc.Sobol(2, scramble=False).random_base2(count.bit_length() - 1).T
    place = np.minimum(np.searchsorted(up_to, u, side="right") - 1, len(areas) - 1)
    side = np.sqrt((u - up_to[place]) / (up_to[place + 1] - up_to[place]))[:, None]
    a, b, c = triangles[place].transpose(1, 0, 2)
    return a + side * ((1 - v[:, None]) * (b - a) + v[:, None] * (c - a))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rays", type=int, default=65536, help="a power of 2")
    parser.add_argument("scene")
    arguments = parser.parse_args()
    surfaces, suns = adapter.read(arguments.scene)
    if any(surface.transmittance > 0 for surface in surfaces):
        adapter.not_supported("rays end at the first surface that they meet")
    scene = rtcore_scene.EmbreeScene()
    casters = [triangles_of(surface) for surface in surfaces if surface.casts]
    # Kept alive as long as the scene.
    mesh = TriangleMesh(scene, np.concatenate(casters).astype(np.float32)) if casters else None
    found = []
    for sun in suns:
        direction = towards(sun["azimuth"], sun["altitude"])
        values = {}
        for surface in surfaces:
            if surface.receives:
                origins = points_of(triangles_of(surface), arguments.rays) + LIFT * surface.normal
                lit = direction @ surface.normal > 0
                if lit and mesh:
                    hits = scene.run(origins.astype(np.float32),
                                     np.tile(direction, (len(origins), 1)).astype(np.float32), query="OCCLUDED")
                    lit = np.mean(hits < 0)
                values[surface.name] = float(lit)
        found.append(values)
    adapter.answer(found)


if __name__ == "__main__":
    main()
