#!/usr/bin/env python3
"""Writes the model of a hotel under a double-curved grid shell of pivoted glass panes.

    generate.py [--glass single|triple] [--turn DEGREES] [--small] > hotel.idf

Two towers stand in a line, west and east of the origin; x is east and y north, in metres. The shell over both is a
half-elliptical arch, whose width and height vary along it. It is a lattice of diamonds, each with a pane in the tangent
plane, turned by --turn about its own centre line along the towers.
"""

import argparse
import bisect
import itertools
import math
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from common import casters, idf, rooms  # noqa: E402

# A tower, along x: end rooms, bays of rooms to the south and the north with a corridor between, end rooms.
END, BAY, ROOM_DEPTH, CORRIDOR = 8.0, 4.5, 8.0, 4.0
DEPTH = 2 * ROOM_DEPTH + CORRIDOR
PODIUM, STOREY, LOUNGE = 5.0, 3.6, 4.0  # heights; the lounge is on the roof, over the corridor
BETWEEN = 40.0  # the towers

# Openings, by left, bottom, width and height on their wall or bay.
BAY_DOOR, BAY_WINDOW = (0.4, 0.05, 1.6, 2.5), (2.4, 0.5, 1.6, 2.05)
END_WINDOW, END_SIDE_WINDOW = (4.0, 0.8, 12.0, 2.0), (1.5, 0.8, 5.0, 2.0)
SHOP_WINDOW = (0.5, 0.4, 6.0, 3.6)  # in every other bay
PODIUM_DOOR, MAIN_DOOR = (6.9, 0.0, 1.6, 2.6), (15.9, 0.0, 1.6, 2.6)
PODIUM_END_WINDOW, PODIUM_SIDE_WINDOW = (4.0, 0.8, 12.0, 3.0), (1.5, 0.8, 5.0, 3.0)
LOUNGE_SIDES, LOUNGE_WINDOW = 1.0, (0.8, 2.4)  # from the ends; bottom, height

# Balconies in front of each room.
BALCONY, BALCONY_GAP, SLAB, RAIL_HEIGHT, RAIL = 1.6, 0.1, 0.2, 1.1, 0.06
LOUVRES, LOUVRE, LOUVRE_PITCH = 6, 0.12, 0.1

# The shell: its overhang beyond the towers; the height of its springing and its mean half width; and the variation of
# its half width and of its crown's height.
SHELL_BEYOND, SHELL_BASE = 9.5, 9.0
HALF_WIDTH, HALF_WIDTH_WAVE, CROWN_WAVE = 24.0, 2.5, 3.0
PANE = 0.88  # of its diamond
FRAME = 0.06
MEMBER, MEMBER_DEPTH, NODE = 0.2, 0.3, 0.25  # NODE: gap between a member's end and the node
STRUT, STRUT_OUT = 0.5, 4.0  # horizontal distance of a strut's foot from the lowest nodes

GLASS = {"single": ["Pane"], "triple": ["Pane", "Gap"] * 2 + ["Pane"]}

Neighbour = casters.Neighbour
NEIGHBOURS = [
    Neighbour(-130, 80, 48, 20, 5, 8, 4, 36),
    Neighbour(-40, 90, 60, 20, 4, 8, 4, 24),
    Neighbour(70, 76, 36, 24, 5, 8, 4, 30),
    Neighbour(-90, -110, 80, 16, 3, 8, 4, 24),
    Neighbour(40, -100, 60, 16, 3, 8, 4, 24),
]


@dataclass(frozen=True)
class Size:
    storeys: int  # of a tower, over the podium
    bays: int
    columns: int  # of diamonds, along the shell
    rows: int
    crown: float  # mean height of the shell
    neighbours: int


FULL = Size(storeys=12, bays=14, columns=58, rows=100, crown=63.0, neighbours=5)
SMALL = Size(storeys=1, bays=4, columns=12, rows=14, crown=22.0, neighbours=1)

ABU_DHABI = "Abu Dhabi,24.4,54.6,4,5"
ABU_DHABI_DAY = "35,10,DefaultMultipliers,,WetBulb,24,,,,,101000"

HEAD = """\
! A hotel of {zones} zones under a shell of {panes:,} panes, {glass} glass, turned {turn:g} degrees.
! Written by generate.py --glass {glass} --turn {turn:g}{flag}.
! Site: Abu Dhabi; any weather file's own site comes first.

""" + idf.preamble("Hotel", ABU_DHABI, ABU_DHABI_DAY, "City") + """\
Site:GroundTemperature:BuildingSurface,23,23,23,24,24,25,25,25,25,24,24,23;

! The pane of Jones and Greenberg's hotel: 69 % of the sun at normal incidence; three make 34 %.
WindowMaterial:Glazing,Pane,SpectralAverage,,0.0057,0.69,0.1,0.1,0.8,0.08,0.08,0,0.84,0.84,0.9;
WindowMaterial:Gas,Gap,Air,0.012;
Construction,Shell Glass,{layers};
Construction,Balustrade Glass,Pane;
GPUShading:TransparentShade,Shell,Pane *,Construction,Shell Glass;
GPUShading:TransparentShade,Balustrades,Balustrade *,Construction,Balustrade Glass;

Output:Variable,*,Zone Ideal Loads Zone Total Heating Energy,Monthly;
Output:Variable,*,Zone Ideal Loads Zone Total Cooling Energy,Monthly;
""" + idf.SOLAR_OUTPUTS


def tower_length(size):
    return size.bays * BAY + 2 * END


def towers(size):
    """{name of a tower: x of its west end}."""
    return {"West": -BETWEEN / 2 - tower_length(size), "East": BETWEEN / 2}


def tower_rooms(tower, x, size):
    y = -DEPTH / 2
    ends, length = (x + END, x + END + size.bays * BAY), tower_length(size)

    def storey(name, low, high, with_corridor):
        inner = CORRIDOR / 2 if with_corridor else 0.0
        parts = size.bays if with_corridor else 1
        yield rooms.Room(f"{name} South Rooms", (ends[0], y, low), (ends[1], -inner, high), parts)
        yield rooms.Room(f"{name} North Rooms", (ends[0], inner, low), (ends[1], -y, high), parts)
        if with_corridor:
            yield rooms.Room(f"{name} Corridor", (ends[0], -inner, low), (ends[1], inner, high))
        yield rooms.Room(f"{name} West End", (x, y, low), (ends[0], -y, high))
        yield rooms.Room(f"{name} East End", (ends[1], y, low), (x + length, -y, high))

    yield from storey(f"{tower} Podium", 0.0, PODIUM, False)
    for number in range(size.storeys):
        yield from storey(f"{tower} Level {number + 1}", floor_of(number), floor_of(number + 1), True)
    top = floor_of(size.storeys)
    yield rooms.Room(f"{tower} Lounge", (ends[0], -CORRIDOR / 2, top), (ends[1], CORRIDOR / 2, top + LOUNGE))


def floor_of(number):
    """Height of a level of guest rooms, from 0."""
    return PODIUM + number * STOREY


def building(size=FULL):
    return [room for tower, x in towers(size).items() for room in tower_rooms(tower, x, size)]


def glass(room, side, name, place, kind="Window", part=0):
    return rooms.opening_on(room, side, name, kind, "Window", *place, part)


def shop_front(room, side, is_main):
    pitch = 2 * BAY
    left, *place = SHOP_WINDOW
    for number in range(round((room.high[0] - room.low[0]) / pitch)):
        yield glass(room, side, f"Window {number + 1}", (left + number * pitch, *place))
    if side == "North":
        yield glass(room, side, "Door", PODIUM_DOOR, "GlassDoor")
        if is_main:
            yield glass(room, side, "Main Door", MAIN_DOOR, "GlassDoor")


def openings(room):
    words = room.name.split(" ")
    podium = words[1] == "Podium"
    side = words[-2]
    if words[-1] == "Lounge":
        bottom, height = LOUNGE_WINDOW
        width = room.high[0] - room.low[0] - 2 * LOUNGE_SIDES
        for face in ("South", "North"):
            yield glass(room, face, "Window", (LOUNGE_SIDES, bottom, width, height))
    elif words[-1] == "End":
        yield glass(room, side, "Window", PODIUM_END_WINDOW if podium else END_WINDOW)
        for face in ("South", "North"):
            yield glass(room, face, "Window", PODIUM_SIDE_WINDOW if podium else END_SIDE_WINDOW)
    elif words[-1] == "Rooms" and podium:
        yield from shop_front(room, side, words[0] == "East")
    elif words[-1] == "Rooms":
        for part in range(room.parts):
            yield glass(room, side, "Door", BAY_DOOR, "GlassDoor", part)
            yield glass(room, side, "Window", BAY_WINDOW, "Window", part)


def balcony(name, left, along, out, floor):
    """Slab, glass balustrade, hand rail and louvres in front of one guest room; left: its position on the wall."""
    far, top = BAY - BALCONY_GAP, (0, 0, 1)
    corners = [casters.add(left, (a, along), (b, out))
               for a, b in ((BALCONY_GAP, 0), (BALCONY_GAP, BALCONY), (far, BALCONY), (far, 0))]  # fmt: skip
    low, high = (tuple(pick(values) for values in zip(*corners, strict=True)) for pick in (min, max))
    wall = "North" if out[1] < 0 else "South"
    yield from casters.box(f"{name} Slab", (*low[:2], floor - SLAB), (*high[:2], floor), (wall,))
    rail = floor + RAIL_HEIGHT
    feet = [corners[0], corners[1], *(casters.add(corners[1], (share * (far - BALCONY_GAP), along))
                                      for share in (1 / 3, 2 / 3)), corners[2], corners[3]]  # fmt: skip
    for number, (a, b) in enumerate(itertools.pairwise(feet), 1):
        yield (f"Balustrade {name} {number}",
               [(*a[:2], rail), (*a[:2], floor), (*b[:2], floor), (*b[:2], rail)])  # fmt: skip
    ends = ((*corner[:2], rail + RAIL / 2) for corner in corners[1:3])
    yield from casters.bar(f"{name} Rail", *ends, RAIL, RAIL, top)
    for number in range(LOUVRES):
        z = floor + STOREY - SLAB - LOUVRE_PITCH * (number + 1)
        a, b = (casters.add((*corner[:2], z), (-LOUVRE / 2, out)) for corner in corners[1:3])
        fall = LOUVRE * math.sqrt(0.5)  # at 45 degrees
        c, d = (casters.add(corner, (fall, out), (-fall, top)) for corner in (a, b))
        yield f"{name} Louvre {number + 1}", [a, c, d, b]


def balconies(size):
    for tower, x in towers(size).items():
        for level, side in itertools.product(range(size.storeys), ("South", "North")):
            out, along = ((0, -1), (1, 0)) if side == "South" else ((0, 1), (-1, 0))
            start = (x + END if side == "South" else x + END + size.bays * BAY, out[1] * DEPTH / 2)
            floor = floor_of(level)
            name = f"{tower} {level + 1} {side}"
            for bay in range(size.bays):
                left = casters.add(start, (bay * BAY, along))
                yield from balcony(f"{name} {bay + 1}", (*left, 0.0), (*along, 0), (*out, 0), floor)
            for number in range(size.bays + 1):
                a = casters.add(start, (number * BAY, along))
                b = casters.add(a, (BALCONY, out))
                top = floor + STOREY - SLAB
                yield f"{name} Partition {number + 1}", [(*a, top), (*a, floor), (*b, floor), (*b, top)]


class Shell:
    """The lattice: nodes at whole numbers (i, j), i along the towers from the west, j over the arch from the south."""

    STEPS = 4000  # points on the arch, which is divided into parts of equal length

    def __init__(self, size):
        self.size = size
        self.length = 2 * (SHELL_BEYOND + tower_length(size)) + BETWEEN
        self.last_i, self.last_j = 2 * size.columns + 1, size.rows + 1
        angles = [math.pi * step / self.STEPS for step in range(self.STEPS + 1)]
        arch = [(HALF_WIDTH * math.cos(angle), (size.crown - SHELL_BASE) * math.sin(angle)) for angle in angles]
        self._lengths = [0.0, *itertools.accumulate(itertools.starmap(math.dist, itertools.pairwise(arch)))]

    def _angle(self, share):
        wanted = share * self._lengths[-1]
        step = min(self.STEPS, max(1, bisect.bisect_left(self._lengths, wanted)))
        before, after = self._lengths[step - 1], self._lengths[step]
        return math.pi * (step - 1 + (wanted - before) / (after - before)) / self.STEPS

    def point(self, i, j):
        x = self.length * (i / self.last_i - 0.5)
        wave = math.cos(4 * math.pi * (abs(x) / self.length - 0.25))  # largest over the middle of the towers
        angle = self._angle(j / self.last_j)
        half, rise = HALF_WIDTH + HALF_WIDTH_WAVE * wave, self.size.crown + CROWN_WAVE * wave - SHELL_BASE
        return x, -half * math.cos(angle), SHELL_BASE + rise * math.sin(angle)

    def diamonds(self):
        """(i, j) of the centre of each diamond, by rows."""
        for row, column in itertools.product(range(self.size.rows), range(self.size.columns)):
            yield 2 * column + 1 + row % 2, row + 1

    def pane(self, i, j, turn):
        """Corners of a pane, starting in the west, and its normal."""
        west, east, south, north = (self.point(i + a, j + b) for a, b in ((-1, 0), (1, 0), (0, -1), (0, 1)))
        middle = tuple(sum(values) / 4 for values in zip(west, east, south, north, strict=True))
        level, up = casters.between(west, east), casters.between(south, north)
        level_way = casters.unit(level)
        normal = casters.unit(casters.cross(level, up))
        up_way = casters.cross(normal, level_way)
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        tilted = casters.add((0, 0, 0), (c, up_way), (s, normal))
        half_level, half_up = PANE * math.hypot(*level) / 2, PANE * math.hypot(*up) / 2
        corners = [casters.add(middle, (a * half_level, level_way), (b * half_up, tilted))
                   for a, b in ((-1, 0), (0, -1), (1, 0), (0, 1))]  # fmt: skip
        return corners, casters.cross(level_way, tilted)

    def edges(self):
        """Pairs of nodes connected by a member, each once, in order."""
        found = {}
        for i, j in self.diamonds():
            nodes = [(i - 1, j), (i, j - 1), (i + 1, j), (i, j + 1)]
            for pair in zip(nodes, nodes[1:] + nodes[:1], strict=True):
                found[tuple(sorted(pair))] = None
        return list(found)

    def normal(self, i, j):
        level = casters.between(self.point(i - 0.5, j), self.point(i + 0.5, j))
        up = casters.between(self.point(i, max(j - 0.5, 0)), self.point(i, min(j + 0.5, self.last_j)))
        return casters.unit(casters.cross(level, up))


def panes(size, turn):
    shell = Shell(size)
    for i, j in shell.diamonds():
        yield f"Pane {i} {j}", shell.pane(i, j, turn)[0]


def frames(size, turn):
    """A rim around each pane."""
    shell = Shell(size)
    for i, j in shell.diamonds():
        corners, normal = shell.pane(i, j, turn)
        for number, (a, b) in enumerate(zip(corners, corners[1:] + corners[:1], strict=True), 1):
            yield f"Frame {i} {j} {number}", [casters.add(a, (FRAME / 2, normal)), casters.add(a, (-FRAME / 2, normal)),
                                              casters.add(b, (-FRAME / 2, normal)), casters.add(b, (FRAME / 2, normal))]


def members(size):
    shell = Shell(size)
    for number, (first, last) in enumerate(shell.edges(), 1):
        start, end = shell.point(*first), shell.point(*last)
        way = casters.unit(casters.between(start, end))
        out = shell.normal(*((a + b) / 2 for a, b in zip(first, last, strict=True)))
        yield from casters.bar(f"Member {number}", casters.add(start, (NODE, way)), casters.add(end, (-NODE, way)),
                               MEMBER, MEMBER_DEPTH, out)  # fmt: skip


def struts(size):
    """Struts from the ground to two lowest nodes each."""
    shell = Shell(size)
    for j, out, side in ((0, -1, "South"), (shell.last_j, 1, "North")):
        nodes = [shell.point(i, j) for i, row in ((a, b) for a, b in shell.diamonds() if b == (1 if j == 0 else j - 1))]
        for number, pair in enumerate(zip(nodes[::2], nodes[1::2], strict=False), 1):
            foot = ((pair[0][0] + pair[1][0]) / 2, pair[0][1] + out * STRUT_OUT, 0.0)
            for name, node in zip("AB", pair, strict=True):
                way = casters.unit(casters.between(foot, node))
                yield from casters.bar(f"Strut {side} {number}{name}", casters.add(foot, (NODE, way)),
                                       casters.add(node, (-NODE, way)), STRUT, STRUT, (0, out, 0))  # fmt: skip


def neighbours(size):
    for number, each in enumerate(NEIGHBOURS[: size.neighbours], 1):
        yield from casters.neighbour(f"Neighbour {number}", each, 0.0)


def casting(size=FULL, turn=20.0):
    """{group: generator of its (name, corners)}."""
    return {"panes": panes(size, turn), "frames": frames(size, turn), "members": members(size),
            "struts": struts(size), "balconies": balconies(size), "neighbours": neighbours(size)}  # fmt: skip


def model(glass_kind="single", turn=20.0, size=FULL):
    everything = building(size)
    yield HEAD.format(zones=len(everything), panes=size.columns * size.rows, glass=glass_kind, turn=turn,
                      flag=" --small" if size is SMALL else "", layers=",".join(GLASS[glass_kind]))  # fmt: skip
    yield from rooms.model_of(everything)
    for room in everything:
        yield from openings(room)
    for part in casting(size, turn).values():
        for name, corners in part:
            yield idf.shade(name, corners, "Site")


def main():
    parser = argparse.ArgumentParser(description="Writes the model of a hotel under a grid shell of glass.")
    parser.add_argument("--glass", choices=GLASS, default="single", help="panes of one or three sheets")
    parser.add_argument("--turn", type=float, default=20.0, metavar="DEGREES", help="angle of each pane to the shell")
    parser.add_argument("--small", action="store_true", help="a small hotel of the same kind, quick to run")
    arguments = parser.parse_args()
    sys.stdout.writelines(model(arguments.glass, arguments.turn, SMALL if arguments.small else FULL))


if __name__ == "__main__":
    main()
