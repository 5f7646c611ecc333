#!/usr/bin/env python3
"""Embree (embreex): rays from Sobol points of each receiver; opaque casters only.

    embree.py [--rays N] SCENE
"""

import numpy as np
import points
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh


def tracer_of(triangles):
    scene = rtcore_scene.EmbreeScene()
    # Kept alive as long as the scene.
    mesh = TriangleMesh(scene, triangles.astype(np.float32)) if len(triangles) else None

    def tracer(direction):
        def lit(origins, _):
            if mesh is None:
                return np.ones(len(origins))
            directions = np.tile(direction, (len(origins), 1)).astype(np.float32)
            return scene.run(origins.astype(np.float32), directions, query="OCCLUDED") < 0

        return lit

    return tracer


if __name__ == "__main__":
    points.answer("--rays", 65536, "rays end at the first surface that they meet", tracer_of)
