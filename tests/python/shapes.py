"""Rectangles, and exact sunlit fractions of polygons in parallel planes."""

import numpy as np


def window(width=2.0, height=1.0, base=1.0, y=0.0):
    """An upright rectangle that faces south."""
    return np.array([[0, y, base], [width, y, base], [width, y, base + height], [0, y, base + height]], dtype=float)


def overhang(depth=0.5, height=2.0, reach=9.0):
    """A level sheet above the window, much wider than it."""
    return np.array([[-reach, -depth, height], [2 + reach, -depth, height], [2 + reach, 0, height],
                     [-reach, 0, height]], dtype=float)


def below_overhang(azimuth, altitude, depth=0.5, height=1.0):
    """Sunlit fraction of the window below that overhang, by the profile angle; the sun is in the south."""
    profile = np.tan(np.radians(altitude)) / np.cos(np.radians(azimuth - 180.0))
    return 1.0 - np.clip(depth * profile / height, 0.0, 1.0)


def towards(azimuth, altitude):
    azimuth, altitude = np.radians(azimuth), np.radians(altitude)
    return np.array([np.cos(altitude) * np.sin(azimuth), np.cos(altitude) * np.cos(azimuth), np.sin(altitude)])


def exact_fraction(shapely, receiver, casters, sun):
    """Of a receiver in the plane y = 0 that faces south, by boolean operations on the polygons of casters before it."""
    lit = shapely.Polygon(receiver[:, [0, 2]])
    whole = lit.area
    for caster in casters:
        # Along the rays onto the plane.
        fallen = caster - np.outer(caster[:, 1] / sun[1], sun)
        lit = lit.difference(shapely.Polygon(fallen[:, [0, 2]]))
    return lit.area / whole
