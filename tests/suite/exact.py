"""Exact sunlit fractions of a scene of the suite, by two methods that share no geometry beyond the axes of a plane."""

import itertools
import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / ".venv" / "tools"))

PLANE = 1e-9  # m: what is nearer to a receiver's plane lies in it


@dataclass
class Surface:
    """Rings of shape (n, 3): the outline and the holes, m."""

    name: str
    rings: list
    receives: bool = False
    casts: bool = True
    transmittance: float = 0.0
    normal: np.ndarray = field(init=False)

    def __post_init__(self):
        outline = self.rings[0]
        vector = np.cross(outline - outline[0], np.roll(outline, -1, axis=0) - outline[0]).sum(axis=0)
        self.normal = vector / np.linalg.norm(vector)


def surfaces_of(scene):
    """The surfaces of a scene as it is read from JSON, with their copies."""
    made = []
    for entry in scene["surfaces"]:
        rings = [np.array(ring, float) for ring in [entry["vertices"], *entry.get("holes", [])]]
        copies = entry.get("copies", {"count": 1, "step": [0, 0, 0]})
        for number in range(copies["count"]):
            name = entry["name"] if copies["count"] == 1 else f"{entry['name']} {number + 1}"
            made.append(Surface(name, [ring + number * np.array(copies["step"], float) for ring in rings],
                                entry.get("receives", False), entry.get("casts", True),
                                entry.get("transmittance", 0.0)))
    return made


def towards(azimuth, altitude):
    """The unit vector to the sun; degrees, the azimuth clockwise from north."""
    azimuth, altitude = math.radians(azimuth), math.radians(altitude)
    return np.array([math.cos(altitude) * math.sin(azimuth), math.cos(altitude) * math.cos(azimuth),
                     math.sin(altitude)])


def axes_of(surface):
    """Two unit vectors in its plane."""
    other = np.eye(3)[np.argmin(np.abs(surface.normal))]
    u = np.cross(other, surface.normal)
    u /= np.linalg.norm(u)
    return np.array([u, np.cross(surface.normal, u)])


def heights(surface, receiver):
    """Of the vertices of its rings above the receiver's plane."""
    return [(ring - receiver.rings[0][0]) @ receiver.normal for ring in surface.rings]


def casters_of(surfaces, receiver):
    for surface in surfaces:
        if surface is receiver or not surface.casts or surface.transmittance == 1.0:
            continue
        if max(each.max() for each in heights(surface, receiver)) > PLANE:
            yield surface


def by_overlay(surfaces, receiver, sun):
    """By GEOS's overlay of polygons (shapely)."""
    import shapely

    facing = sun @ receiver.normal
    if facing <= 0:
        return 0.0
    axes = axes_of(receiver)
    origin = receiver.rings[0][0]

    def shadow(caster):
        # In the caster's own plane, the part before the receiver is what half a plane leaves; an affine map leads on.
        own = axes_of(caster)
        base = caster.rings[0][0]
        flat = shapely.Polygon((caster.rings[0] - base) @ own.T, [(ring - base) @ own.T for ring in caster.rings[1:]])
        across = own @ receiver.normal
        height = (base - origin) @ receiver.normal
        slope = np.linalg.norm(across)
        if slope > 1e-12:
            far = 4 * np.abs(flat.bounds).max() + abs(height) / slope + 1.0
            up = across / slope
            side = np.array([-up[1], up[0]])
            foot = -height / slope * up
            flat = flat.intersection(shapely.Polygon([foot - far * side, foot + far * side,
                                                      foot + far * side + 4 * far * up,
                                                      foot - far * side + 4 * far * up]))

        def project(points):
            space = base + points @ own - origin
            return (space - np.outer(space @ receiver.normal, sun) / facing) @ axes.T

        return shapely.transform(flat, project)

    outline = [(ring - origin) @ axes.T for ring in receiver.rings]
    whole = shapely.Polygon(outline[0], outline[1:])
    casters = list(casters_of(surfaces, receiver))
    opaque = shapely.union_all([shadow(each) for each in casters if each.transmittance == 0.0])
    pieces = [(whole.difference(opaque), 1.0)]
    for caster in casters:
        if caster.transmittance == 0.0:
            continue
        shape = shadow(caster)
        apart = [(piece.difference(shape), share) for piece, share in pieces]
        behind = [(piece.intersection(shape), share * caster.transmittance) for piece, share in pieces]
        pieces = [(piece, share) for piece, share in apart + behind if not piece.is_empty]
    return sum(piece.area * share for piece, share in pieces) / whole.area


def clipped(ring, height):
    """The part of a ring above height 0, by Sutherland and Hodgman: what it adds along the line cancels by parity."""
    kept = []
    for (a, h), (b, k) in itertools.pairwise([*zip(ring, height, strict=True), (ring[0], height[0])]):
        if h >= 0:
            kept.append(a)
        if (h >= 0) != (k >= 0):
            kept.append(a + h / (h - k) * (b - a))
    return np.array(kept)


def by_slabs(surfaces, receiver, sun):
    """By strips between all crossings of edges, in each of which what is lit changes linearly."""
    facing = sun @ receiver.normal
    if facing <= 0:
        return 0.0
    axes = axes_of(receiver)
    # Turned, so that no edge of common models runs along the strips.
    turn = np.array([[math.cos(0.7), math.sin(0.7)], [-math.sin(0.7), math.cos(0.7)]]) @ axes
    origin = receiver.rings[0][0]
    shares, starts, ends, owners = [1.0], [], [], []

    def add(rings, owner):
        for ring in rings:
            if len(ring) < 3:
                continue
            space = ring - origin
            flat = (space - np.outer(space @ receiver.normal, sun) / facing) @ turn.T
            starts.append(flat)
            ends.append(np.roll(flat, -1, axis=0))
            owners.append(np.full(len(flat), owner))

    add(receiver.rings, 0)
    for caster in casters_of(surfaces, receiver):
        add([clipped(ring, height) for ring, height in
             zip(caster.rings, heights(caster, receiver), strict=True)], len(shares))
        shares.append(caster.transmittance)
    a, b, owner = np.concatenate(starts), np.concatenate(ends), np.concatenate(owners)
    low, high = a[owner == 0].min(axis=0), a[owner == 0].max(axis=0)
    near = ((np.maximum(a, b) >= low - 1e-9) & (np.minimum(a, b) <= high + 1e-9))[:, 1]
    a, b, owner = a[near], b[near], owner[near]
    levels = [a[:, 1], b[:, 1]]
    for i in range(len(a) - 1):
        d, e = b[i] - a[i], b[i + 1:] - a[i + 1:]
        cross = d[0] * e[:, 1] - d[1] * e[:, 0]
        apart = a[i + 1:] - a[i]
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (apart[:, 0] * e[:, 1] - apart[:, 1] * e[:, 0]) / cross
            s = (apart[:, 0] * d[1] - apart[:, 1] * d[0]) / cross
        met = (t >= 0) & (t <= 1) & (s >= 0) & (s <= 1)
        levels.append(a[i, 1] + t[met] * d[1])
    levels = np.unique(np.clip(np.concatenate(levels), low[1], high[1]))
    lit = whole = 0.0
    for bottom, top in itertools.pairwise(levels):
        middle = 0.5 * (bottom + top)
        span = (a[:, 1] <= middle) != (b[:, 1] <= middle)
        share = (middle - a[span, 1]) / (b[span, 1] - a[span, 1])
        x = a[span, 0] + share * (b[span, 0] - a[span, 0])
        order = np.argsort(x)
        inside = set()
        for (left, of), (right, _) in itertools.pairwise(zip(x[order], owner[span][order], strict=True)):
            inside ^= {int(of)}
            if 0 in inside and right > left:
                area = (right - left) * (top - bottom)
                whole += area
                lit += area * math.prod(shares[each] for each in inside if each)
    return lit / whole
