#!/usr/bin/env python3
"""Writes the model of an academic building behind folded, perforated screens, among terrain and neighbours.

    generate.py [--screen small|large|gradient] [--small] [--image gradient.png] > academic_building.idf

The building stands on level ground around the origin, x east, y north, in metres.
"""

import argparse
import itertools
import math
import sys
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "screened_room")]

import random_holes  # noqa: E402
from common import casters, idf, rooms  # noqa: E402
from shading_runs import output_folder  # noqa: E402
from shading_runs.errors import in_words  # noqa: E402

LENGTH, ROOM_DEPTH, CORRIDOR, STOREY = 64.0, 9.5, 3.0, 4.0
DEPTH = 2 * ROOM_DEPTH + CORRIDOR
GROUND_ROOMS = {"Room 1": 16.0, "Lobby": 32.0, "Room 2": 16.0}  # along either side, by width
UPPER_ROOMS = {f"Room {number}": 16.0 for number in (1, 2, 3, 4)}

# Openings, by left, bottom, width and height on their wall.
GROUND_WINDOW = (2.0, 0.6, 12.0, 2.6)
LOBBY_WINDOW, LOBBY_DOOR = (2.0, 0.3, 22.0, 3.2), (26.0, 0.0, 2.4, 2.6)
UPPER_WINDOWS = {"Window 1": (1.0, 0.9, 6.5, 2.3), "Window 2": (8.5, 0.9, 6.5, 2.3)}
END_WINDOW = (1.0, 0.9, 7.5, 2.3)
CORRIDOR_WINDOW = (0.5, 0.9, 2.0, 2.3)
GROUND_CORRIDOR_WINDOW, CORRIDOR_DOOR = (0.3, 0.9, 1.0, 2.3), (1.5, 0.0, 1.2, 2.2)
SKYLIGHTS, SKYLIGHT = 4, (4.0, 1.6)

# The screen goes around the building in folds between two lines in front of its walls, up to the next storey's sills.
SCREEN_NEAR, SCREEN_FAR, SCREEN_ABOVE = 1.0, 1.3, 0.9
THICKNESS = 0.00635
OPEN = 0.5
HOLES = {"small": 0.00635, "large": 0.0254}  # diameters
IMAGE, TEXEL = "gradient.png", 0.002
SCREENS = {"small": "round holes of 6.35 mm", "large": "round holes of 25.4 mm",
           "gradient": "holes of 6 to 30 mm at random, more of them towards the top"}  # fmt: skip

# Terrain: level around the building, then rising to the east, with waves.
GROUND, LEVEL_WITHIN, FULL_BEYOND = -0.15, 110.0, 330.0
SLOPE, WAVE, WAVE_X, WAVE_Y = 0.09, 6.0, 70.0, 90.0

Neighbour = casters.Neighbour
NEIGHBOURS = [
    Neighbour(-34, -62, 48, 16, 5, 9, 4, 70),
    Neighbour(30, -70, 32, 20, 6, 9, 3, 36),
    Neighbour(58, -20, 20, 44, 6, 10, 4, 60),
    Neighbour(-84, -30, 24, 48, 5, 9, 4, 84),
    Neighbour(-60, 42, 52, 20, 4, 10, 5, 60),
    Neighbour(14, 40, 40, 20, 6, 9, 4, 48),
    Neighbour(-20, -110, 60, 20, 4, 10, 6, 72),
    Neighbour(90, 40, 28, 28, 7, 9, 4, 48),
    Neighbour(96, -64, 24, 36, 8, 9, 3, 54),
    Neighbour(-130, 24, 36, 24, 4, 9, 4, 54),
    Neighbour(-128, -84, 28, 32, 5, 10, 3, 60),
]


@dataclass(frozen=True)
class Size:
    storeys: int
    screened: tuple  # storeys, counted from 0 at the ground
    strip: float  # of the screen, along the wall
    cells: int  # of terrain, along a side
    cell: float
    neighbours: int


FULL = Size(storeys=4, screened=(1, 2), strip=0.5, cells=100, cell=8.0, neighbours=11)
SMALL = Size(storeys=2, screened=(1,), strip=1.0, cells=12, cell=32.0, neighbours=2)

ITHACA = "Ithaca,42.44,-76.5,-5,250"
ITHACA_DAY = "20,10,DefaultMultipliers,,WetBulb,10,,,,,98000"

HEAD = """\
! An academic building of {zones} zones behind folded screens with {holes}.
! Written by generate.py --screen {screen}{flag}.
! Site: Ithaca, New York; any weather file's own site comes first.

""" + idf.preamble("Academic Building", ITHACA, ITHACA_DAY, "City") + """\
Site:GroundTemperature:BuildingSurface,17,17,17,17,18,19,20,20,20,19,18,17;

Material,Door Leaf,Smooth,0.05,0.15,700,1500;
Construction,Door,Door Leaf;

Output:Variable,*,Zone Ideal Loads Zone Total Heating Energy,Monthly;
Output:Variable,*,Zone Ideal Loads Zone Total Cooling Energy,Monthly;
""" + idf.SOLAR_OUTPUTS


def storey_rooms(storey):
    """Rooms along the south and the north side, with a corridor between them."""
    x, y, z, top = -LENGTH / 2, -DEPTH / 2, storey * STOREY, (storey + 1) * STOREY
    name = f"Level {storey + 1}"
    yield rooms.Room(f"{name} Corridor", (x, y + ROOM_DEPTH, z), (-x, y + ROOM_DEPTH + CORRIDOR, top))
    for side, low in (("South", y), ("North", y + ROOM_DEPTH + CORRIDOR)):
        left = x
        for room, width in (UPPER_ROOMS if storey else GROUND_ROOMS).items():
            yield rooms.Room(f"{name} {side} {room}", (left, low, z), (left + width, low + ROOM_DEPTH, top))
            left += width


def openings(room, storey, last):
    if room.name.endswith("Corridor"):
        for side in ("West", "East"):
            if storey:
                yield rooms.opening_on(room, side, "Window", "Window", "Window", *CORRIDOR_WINDOW)
            else:
                yield rooms.opening_on(room, side, "Window", "Window", "Window", *GROUND_CORRIDOR_WINDOW)
                yield rooms.opening_on(room, side, "Door", "Door", "Door", *CORRIDOR_DOOR)
        for number in range(SKYLIGHTS if last else 0):
            x = LENGTH * ((number + 0.5) / SKYLIGHTS - 0.5)
            corners = rooms.level(room.high[2], (x - SKYLIGHT[0] / 2, -SKYLIGHT[1] / 2),
                                  (x + SKYLIGHT[0] / 2, SKYLIGHT[1] / 2))  # fmt: skip
            yield idf.opening(f"{room.name} Skylight {number + 1}", "Window", "Window", f"{room.name} Top", corners)
        return
    side = "South" if " South " in room.name else "North"
    if storey:
        for name, place in UPPER_WINDOWS.items():
            yield rooms.opening_on(room, side, name, "Window", "Window", *place)
    elif room.name.endswith("Lobby"):
        kind, construction = ("GlassDoor", "Window") if side == "South" else ("Door", "Door")
        yield rooms.opening_on(room, side, "Window", "Window", "Window", *LOBBY_WINDOW)
        yield rooms.opening_on(room, side, "Door", kind, construction, *LOBBY_DOOR)
    else:
        yield rooms.opening_on(room, side, "Window", "Window", "Window", *GROUND_WINDOW)
    for end, x in (("West", room.low[0]), ("East", room.high[0])):
        if abs(abs(x) - LENGTH / 2) < rooms.LOW:
            yield rooms.opening_on(room, end, "Window", "Window", "Window", *END_WINDOW)


def folds(strip):
    """{side: the corners of the screen's folds seen from above, from left to right}."""
    x, y = LENGTH / 2 + SCREEN_NEAR, DEPTH / 2 + SCREEN_NEAR
    far = SCREEN_FAR - SCREEN_NEAR
    found = {}
    for side, start, along, out, length in (("South", (-x, -y), (1, 0), (0, -1), 2 * x),
                                            ("East", (x, -y), (0, 1), (1, 0), 2 * y),
                                            ("North", (x, y), (-1, 0), (0, 1), 2 * x),
                                            ("West", (-x, y), (0, -1), (-1, 0), 2 * y)):  # fmt: skip
        count = 2 * round(length / strip / 2)
        found[side] = [casters.add(start, (length * i / count, along), (far * (i % 2), out)) for i in range(count + 1)]
    return found


def strip_size(size):
    """Width and height of a strip; each screened storey has a row of strips."""
    return math.dist(*folds(size.strip)["South"][:2]), STOREY + SCREEN_ABOVE / len(size.screened)


def screen_strips(size):
    _, height_of_row = strip_size(size)
    for side, corners in folds(size.strip).items():
        for row in range(len(size.screened)):
            bottom = size.screened[0] * STOREY + row * height_of_row
            top = bottom + height_of_row
            for number, (left, right) in enumerate(itertools.pairwise(corners), 1):
                yield (f"Screen {side} {row + 1} {number}",
                       [(*left, top), (*left, bottom), (*right, bottom), (*right, top)])  # fmt: skip


def screen_dimensions(screen):
    """Pitch, diameter and thickness of a sheet with round holes."""
    diameter = HOLES[screen]
    return diameter * math.sqrt(math.pi / (2 * math.sqrt(3)) / OPEN), diameter, THICKNESS


def screen_object(screen):
    if screen == "gradient":
        return (f"\nGPUShading:PerforatedScreen,Sheet,Screen *,\n  Texture,{IMAGE},,,,,,\n"
                f"  {THICKNESS};                 !- Thickness {{m}}\n")  # fmt: skip
    pitch, diameter, _ = screen_dimensions(screen)
    return (f"\nGPUShading:PerforatedScreen,Sheet,Screen *,\n  Round,,Staggered60,\n"
            f"  {diameter},                 !- Hole Size {{m}}\n  ,\n  {pitch:.7f},               !- Pitch {{m}}\n  ,\n"
            f"  {THICKNESS};                 !- Thickness {{m}}\n")  # fmt: skip


def write_image(path, size=FULL):
    """The sheet of one strip."""
    output_folder.write_file(path, random_holes.png(random_holes.opacity(*strip_size(size), TEXEL)))


def height(x, y):
    """Height of the terrain."""
    share = min(1.0, max(0.0, (math.hypot(x, y) - LEVEL_WITHIN) / (FULL_BEYOND - LEVEL_WITHIN)))
    smooth = share * share * (3 - 2 * share)
    return GROUND + smooth * (SLOPE * x + WAVE * math.sin(x / WAVE_X) * math.cos(y / WAVE_Y))


def terrain(size):
    """Two triangles per cell, except for cells under the building."""
    half = size.cells * size.cell / 2

    def node(column, row):
        x, y = column * size.cell - half, row * size.cell - half
        return x, y, height(x, y)

    for column in range(size.cells):
        for row in range(size.cells):
            (x1, y1, _), (x2, y2, _) = node(column, row), node(column + 1, row + 1)
            if x1 < LENGTH / 2 and x2 > -LENGTH / 2 and y1 < DEPTH / 2 and y2 > -DEPTH / 2:
                continue
            a, b = node(column + 1, row), node(column, row + 1)
            yield f"Terrain {column + 1} {row + 1} A", [node(column, row), a, node(column + 1, row + 1)]
            yield f"Terrain {column + 1} {row + 1} B", [node(column, row), node(column + 1, row + 1), b]


def neighbours(size):
    for number, building in enumerate(NEIGHBOURS[: size.neighbours], 1):
        corners = [(building.x + i * building.width, building.y + j * building.depth) for i in (0, 1) for j in (0, 1)]
        yield from casters.neighbour(f"Neighbour {number}", building, max(height(*corner) for corner in corners))


def casting(size=FULL):
    """{group: generator of its (name, corners)}."""
    return {"screen": screen_strips(size), "terrain": terrain(size), "neighbours": neighbours(size)}


def building(size=FULL):
    return [room for storey in range(size.storeys) for room in storey_rooms(storey)]


def model(screen="small", size=FULL):
    everything = building(size)
    yield HEAD.format(zones=len(everything), holes=SCREENS[screen], screen=screen,
                      flag=" --small" if size is SMALL else "")  # fmt: skip
    yield from rooms.model_of(everything)
    for room in everything:
        storey = round(room.low[2] / STOREY)
        yield from openings(room, storey, storey == size.storeys - 1)
    for part in casting(size).values():
        for name, corners in part:
            yield idf.shade(name, corners, "Site")
    yield screen_object(screen)


def main():
    parser = argparse.ArgumentParser(description="Writes the model of an academic building behind folded screens.")
    parser.add_argument("--screen", choices=SCREENS, default="small",
                        help="holes of 6.35 mm, of 25.4 mm, or a random gradient of holes (default: small)")
    parser.add_argument("--small", action="store_true", help="a small building of the same kind, quick to run")
    parser.add_argument("--image", metavar="FILE", help=f"write the gradient's image too; the model reads {IMAGE}")
    arguments = parser.parse_args()
    size = SMALL if arguments.small else FULL
    if arguments.image:
        try:
            write_image(arguments.image, size)
        except (OSError, output_folder.NotOurs) as error:
            sys.exit(f"academic_building: {in_words(error)}")
    sys.stdout.writelines(model(arguments.screen, size))


if __name__ == "__main__":
    main()
