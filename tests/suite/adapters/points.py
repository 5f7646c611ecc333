"""What adapters of tools that trace rays share: sunlit fractions from points on each receiver."""

import argparse

import adapter
import numpy as np
import shapely
from exact import axes_of, towards
from scipy.stats import qmc

LIFT = 1e-4  # m: a point is this far before its receiver


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


def answer(option, count, unsupported, make_tracer):
    """The command line, `OPTION N SCENE`, and the answers of a tool without glass (`unsupported`: why).

    make_tracer(triangles) of all casters returns a function of the direction to the sun, and that a function of points
    and the normal of their receiver: which of them the beam reaches. Coordinates are those around the first receiver,
    because such tools have single precision.
    """
    parser = argparse.ArgumentParser()
    parser.add_argument(option, dest="points", type=int, default=count, help="for each receiver, a power of 2")
    parser.add_argument("scene")
    arguments = parser.parse_args()
    surfaces, suns = adapter.read(arguments.scene)
    if any(surface.transmittance > 0 for surface in surfaces):
        adapter.not_supported(unsupported)
    receivers = [surface for surface in surfaces if surface.receives]
    centre = receivers[0].rings[0][0]
    casters = [triangles_of(surface) - centre for surface in surfaces if surface.casts]
    tracer = make_tracer(np.concatenate(casters) if casters else np.empty((0, 3, 3)))
    points = [points_of(triangles_of(receiver), arguments.points) - centre + LIFT * receiver.normal
              for receiver in receivers]
    found = []
    for sun in suns:
        direction = towards(sun["azimuth"], sun["altitude"])
        lit = tracer(direction)
        found.append({receiver.name: np.mean(lit(of, receiver.normal)) if direction @ receiver.normal > 0 else 0.0
                      for receiver, of in zip(receivers, points, strict=True)})
    adapter.answer(found)
