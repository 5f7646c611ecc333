"""Triangles of a surface, and points on it, for adapters that trace rays."""

import adapter  # noqa: F401  (finds packages)
import numpy as np
import shapely
from exact import axes_of
from scipy.stats import qmc


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
