"""Solids that cast shadows, as (name, corners) of each of their outward faces, in metres."""

import math
from dataclasses import dataclass

from common.rooms import SIDES, outline


def add(point, *moves):
    """A point moved by vectors, each (length, direction)."""
    return tuple(p + sum(length * way[i] for length, way in moves) for i, p in enumerate(point))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(vector):
    length = math.hypot(*vector)
    return tuple(value / length for value in vector)


def between(start, end):
    return tuple(b - a for a, b in zip(start, end, strict=True))


def box(name, low, high, without=()):
    """The six sides of a box, except those that touch something."""
    for side in SIDES:
        if side not in without:
            yield f"{name} {side}", outline(side, low, high)


def bar(name, start, end, width, depth, out):
    """The four long faces of a bar of rectangular section; `out` is roughly along its depth."""
    along = unit(between(start, end))
    across = unit(cross(along, out))
    deep = cross(across, along)
    half, half_deep = width / 2, depth / 2
    corners = [(half, half_deep), (-half, half_deep), (-half, -half_deep), (half, -half_deep)]
    for number, ((a, b), (c, d)) in enumerate(zip(corners, corners[1:] + corners[:1], strict=True), 1):
        yield f"{name} {number}", [add(start, (a, across), (b, deep)), add(end, (a, across), (b, deep)),
                                   add(end, (c, across), (d, deep)), add(start, (c, across), (d, deep))]  # fmt: skip


@dataclass(frozen=True)
class Neighbour:
    """A building of boxes: x and y of its south-west corner, its size, and its details.

    Each storey has a ledge around its top, fins between bays, and louvres in front of its south and west windows. On
    the roof are plant boxes and solar panels, the panels without their frames.
    """

    x: float
    y: float
    width: float
    depth: float
    storeys: int
    louvres: int  # before each bay of a storey
    plant: int = 0
    panels: int = 0

    STOREY = 3.8
    BAY = 4.0
    LEDGE, LEDGE_THICKNESS = 0.6, 0.3
    LOUVRE, LOUVRE_OFF, LOUVRE_TILT = 0.3, 0.3, 30.0  # deep, its middle from the wall, degrees
    FOOT = 1.0  # that walls go on below the base

    @property
    def bays(self):
        return round(self.width / self.BAY), round(self.depth / self.BAY)

    @property
    def count(self):
        """The number of its faces."""
        along, across = self.bays
        fins = 2 * (along - 1) + 2 * (across - 1)
        return (5 + self.storeys * (12 + fins + self.louvres * (along + across)) + 5 * self.plant + self.panels)


def facades(building):
    """(side, its lower left corner, direction along it, outward, length, bays)."""
    x1, y1 = building.x, building.y
    x2, y2 = x1 + building.width, y1 + building.depth
    along, across = building.bays
    return [("South", (x1, y1, 0.0), (1, 0, 0), (0, -1, 0), building.width, along),
            ("East", (x2, y1, 0.0), (0, 1, 0), (1, 0, 0), building.depth, across),
            ("North", (x2, y2, 0.0), (-1, 0, 0), (0, 1, 0), building.width, along),
            ("West", (x1, y2, 0.0), (0, -1, 0), (-1, 0, 0), building.depth, across)]  # fmt: skip


UP = (0.0, 0.0, 1.0)


def ledge(name, building, start, along, outward, length, top):
    """Top, underside and front, with mitred ends."""
    out, thick = building.LEDGE, building.LEDGE_THICKNESS
    inner = [add(start, (top, UP)), add(start, (top, UP), (length, along))]
    outer = [add(inner[0], (out, outward), (-out, along)), add(inner[1], (out, outward), (out, along))]
    yield f"{name} Top", [inner[0], outer[0], outer[1], inner[1]]
    low_inner, low_outer = ([add(corner, (-thick, UP)) for corner in pair] for pair in (inner, outer))
    yield f"{name} Underside", [low_inner[1], low_outer[1], low_outer[0], low_inner[0]]
    yield f"{name} Front", [outer[0], low_outer[0], low_outer[1], outer[1]]


def storey_front(name, building, storey, base, facade):
    """Ledge, fins and louvres of one storey on one side."""
    side, corner, along, outward, length, bays = facade
    name = f"{name} {side} {storey + 1}"
    bottom = base + storey * building.STOREY
    top = bottom + building.STOREY
    yield from ledge(f"{name} Ledge", building, corner, along, outward, length, top)
    clear = building.LEDGE_THICKNESS
    for number in range(1, bays):
        foot = add(corner, (length * number / bays, along), (bottom, UP))
        head = add(foot, (building.STOREY - clear, UP))
        yield f"{name} Fin {number}", [head, foot, *(add(end, (building.LEDGE, outward)) for end in (foot, head))]
    if side not in ("South", "West"):
        return
    tilt = math.radians(building.LOUVRE_TILT)
    half = building.LOUVRE / 2
    for bay in range(bays):
        left, right = length * bay / bays + 0.1, length * (bay + 1) / bays - 0.1
        for number in range(building.louvres):
            z = bottom + (building.STOREY - clear) * (number + 1) / (building.louvres + 1)
            middle = add(corner, (z, UP), (building.LOUVRE_OFF, outward))
            back = add(middle, (-half * math.cos(tilt), outward), (half * math.sin(tilt), UP))
            front = add(middle, (half * math.cos(tilt), outward), (-half * math.sin(tilt), UP))
            ends = ((back, left), (front, left), (front, right), (back, right))
            yield f"{name} Louvre {bay + 1}-{number + 1}", [add(edge, (end, along)) for edge, end in ends]


def roof_places(building, number, step_x, step_y, row):
    """Lower left corners of objects in rows on a roof, starting in the south-west."""
    a_row = max(1, int((building.width - 2) // step_x))
    x, y = building.x + 1, building.y + 1 + row
    return [(x + step_x * (i % a_row), y + step_y * (i // a_row)) for i in range(number)]


def neighbour(name, building, base):
    """The building's faces; base: the height of its ground floor."""
    x1, y1 = building.x, building.y
    x2, y2 = x1 + building.width, y1 + building.depth
    top = base + building.storeys * building.STOREY
    yield from box(f"{name} Body", (x1, y1, base - building.FOOT), (x2, y2, top), ("Bottom",))
    for facade in facades(building):
        for storey in range(building.storeys):
            yield from storey_front(name, building, storey, base, facade)
    for number, (x, y) in enumerate(roof_places(building, building.plant, 4.0, 3.5, 0.0), 1):
        yield from box(f"{name} Plant {number}", (x, y, top), (x + 3, y + 2.5, top + 2), ("Bottom",))
    rows = 3.5 * math.ceil(building.plant / max(1, int((building.width - 2) // 4)))
    tilt = math.radians(30)
    for number, (x, y) in enumerate(roof_places(building, building.panels, 1.2, 1.8, rows), 1):
        if y + 1.7 > y2:
            raise ValueError(f"{name}: {building.panels} panels do not fit its roof")
        low, high = top + 0.2, top + 0.2 + 1.7 * math.sin(tilt)
        end = y + 1.7 * math.cos(tilt)
        yield f"{name} Panel {number}", [(x, end, high), (x, y, low), (x + 1, y, low), (x + 1, end, high)]
