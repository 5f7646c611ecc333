#!/usr/bin/env python3
"""Embree (embreex): rays from Sobol points of each receiver; opaque casters only.

    embree.py [--rays N] SCENE
"""

import argparse

import adapter
import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
from exact import towards
from points import points_of, triangles_of

LIFT = 1e-4  # m: a ray begins this far before its receiver


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rays", type=int, default=65536, help="a power of 2")
    parser.add_argument("scene")
    arguments = parser.parse_args()
    surfaces, suns = adapter.read(arguments.scene)
    if any(surface.transmittance > 0 for surface in surfaces):
        adapter.not_supported("rays end at the first surface that they meet")
    scene = rtcore_scene.EmbreeScene()
    centre = next(surface.rings[0][0] for surface in surfaces if surface.receives)  # Embree has single precision
    casters = [triangles_of(surface) - centre for surface in surfaces if surface.casts]
    # Kept alive as long as the scene.
    mesh = TriangleMesh(scene, np.concatenate(casters).astype(np.float32)) if casters else None
    found = []
    for sun in suns:
        direction = towards(sun["azimuth"], sun["altitude"])
        values = {}
        for surface in surfaces:
            if surface.receives:
                origins = points_of(triangles_of(surface), arguments.rays) - centre + LIFT * surface.normal
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
