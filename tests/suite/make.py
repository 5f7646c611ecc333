#!/usr/bin/env python3
"""Writes the scenes of the suite that have a closed form or a random seed, and the answers of all scenes.

    make.py [--answers-only]

Scenes of public reports are written by hand, without answers. An answer is kept only if both methods of exact.py agree
within 1e-10 on it.
"""

import json
import math
import random
import sys
from pathlib import Path

import exact
import numpy as np

FOLDER = Path(__file__).resolve().parent
SUNS = json.loads((FOLDER / "suns.json").read_text())
AGREE = 1e-10
SEED = 20261130  # chosen before any tool was run
WEST_SUN, LOW_SUN = "06-21 17:15", "12-21 16:30"


class Facade:
    """Points by what somebody outside sees: metres to the right, up, and out of the wall."""

    def __init__(self, azimuth=180.0, tilt=90.0, origin=(0.0, 0.0, 0.0)):
        a, t = math.radians(azimuth), math.radians(tilt)
        self.right = np.array([-math.cos(a), math.sin(a), 0.0])
        self.out = np.array([math.sin(a) * math.sin(t), math.cos(a) * math.sin(t), math.cos(t)])
        self.up = np.cross(self.out, self.right)
        self.origin = np.array(origin, float)

    def at(self, *points):
        return [[round(float(c), 12) for c in self.origin + x * self.right + y * self.up + z * self.out]
                for x, y, z in points]

    def rectangle(self, x, y, width, height, out=0.0):
        return self.at((x, y + height, out), (x, y, out), (x + width, y, out), (x + width, y + height, out))

    def shape(self, points, out=0.0):
        return self.at(*((x, y, out) for x, y in points))

    def shelf(self, x, y, width, depth, drop=0.0, out=0.0):
        """A blade that leaves the wall at a height."""
        return self.at((x, y, out), (x, y - drop, out + depth), (x + width, y - drop, out + depth), (x + width, y, out))

    def fin(self, x, y, height, depth, out=0.0):
        return self.at((x, y + height, out), (x, y, out), (x, y, out + depth), (x, y + height, out + depth))

    def step(self, right=0.0, up=0.0, out=0.0):
        return [round(float(c), 12) for c in right * self.right + up * self.up + out * self.out]


SOUTH = Facade()
WINDOW = SOUTH.rectangle(0, 0, 3, 1.5)
L = [(0, 0), (1, 0), (1, 2), (2, 2), (2, 3), (0, 3)]
STAR = [(math.sin(i * math.pi / 5) * (1.0, 0.4)[i % 2], math.cos(i * math.pi / 5) * (1.0, 0.4)[i % 2])
        for i in range(10)][::-1]


def receiver(vertices, **more):
    return {"name": "Receiver", "receives": True, "casts": False, "vertices": vertices, **more}


def shade(name, vertices, **more):
    return {"name": name, "vertices": vertices, **more}


def copies(count, step):
    return {"copies": {"count": count, "step": step}}


def plate(columns, rows, size, pitch, out):
    """Holes of a square plate of 3 x 3 m that begin at 0.3 m from its corner."""
    return [SOUTH.rectangle(0.3 + pitch * i, 0.3 + pitch * j, size, size, out)
            for i in range(columns) for j in range(rows)]


def thick_plate():
    holes = [(0.3 + 0.8 * i, 0.3 + 0.8 * j) for i in range(3) for j in range(3)]
    faces = [shade(f"Face {k}", SOUTH.rectangle(0, 0, 3, 3, out), holes=plate(3, 3, 0.6, 0.8, out))
             for k, out in enumerate((0.5, 0.7))]
    walls = []
    for k, (x, y) in enumerate(holes):
        for side, vertices in enumerate((SOUTH.shelf(x, y, 0.6, 0.2, 0, 0.5), SOUTH.shelf(x, y + 0.6, 0.6, 0.2, 0, 0.5),
                                         SOUTH.fin(x, y, 0.6, 0.2, 0.5), SOUTH.fin(x + 0.6, y, 0.6, 0.2, 0.5))):
            walls.append(shade(f"Hole {k} wall {side}", vertices))
    return faces + walls


def turned(azimuth):
    facade = Facade(azimuth, origin=(12.3, -4.5, 2.0))
    return [receiver(facade.rectangle(0, 0, 3, 1.5)),
            shade("Louvre", facade.shelf(-0.2, 0.05, 3.4, 0.12, 0.05, 0.05), **copies(15, facade.step(up=0.1)))]


def box(x, y, width, depth, height):
    """Five faces of a body that stands on the ground."""
    a, b, c, d = (x, y), (x + width, y), (x + width, y + depth), (x, y + depth)
    sides = [[[*p, height], [*p, 0.0], [*q, 0.0], [*q, height]] for p, q in ((a, b), (b, c), (c, d), (d, a))]
    return [*sides, [[*p, height] for p in (a, b, c, d)]]


far = [500_000.0, 4_000_000.0, 250.0]
roof = Facade(180, 30)
CLOSED = {
    "overhang-wide": ("overhangs", "An overhang wider than its window.", ["03-21 11:15", "03-21 09:15", "06-21 11:15"],
                      [receiver(WINDOW), shade("Overhang", SOUTH.shelf(-1, 1.8, 5, 1.0))]),
    "overhang-narrow": ("overhangs", "An overhang narrower than its window.", ["03-21 11:15", "03-21 15:15"],
                        [receiver(WINDOW), shade("Overhang", SOUTH.shelf(0.7, 1.6, 1.2, 0.8))]),
    "overhang-touching": ("shades that touch", "An overhang along the window's upper edge.",
                          ["03-21 11:15", "12-21 09:15"],
                          [receiver(WINDOW), shade("Overhang", SOUTH.shelf(0, 1.5, 3, 0.6))]),
    "overhang-sloped": ("overhangs", "An overhang that slopes down.", ["03-21 11:15", "01-21 13:15"],
                        [receiver(WINDOW), shade("Overhang", SOUTH.shelf(-0.5, 1.7, 4, 0.9, 0.4))]),
    "fin-west": ("overhangs", "One fin beside a window.", ["03-21 15:15", "12-21 15:15"],
                 [receiver(WINDOW), shade("Fin", SOUTH.fin(-0.2, -0.5, 2.5, 0.7))]),
    "overhang-and-fins": ("overhangs", "An overhang and two fins, whose shadows overlap.",
                          ["03-21 15:15", "01-21 09:15"],
                          [receiver(WINDOW), shade("Overhang", SOUTH.shelf(-0.3, 1.7, 3.6, 0.8)),
                           shade("Fin 1", SOUTH.fin(-0.3, 0, 1.7, 0.8)), shade("Fin 2", SOUTH.fin(3.3, 0, 1.7, 0.8))]),
    "caster-behind": ("overhangs", "What stands behind the receiver's plane does not shade it.", ["03-21 11:15"],
                      [receiver(WINDOW), shade("Behind", SOUTH.rectangle(-1, -1, 5, 5, -0.5)),
                       shade("Overhang", SOUTH.shelf(-1, 1.8, 5, 1.0))]),
    "caster-through": ("overhangs", "Of a shade through the receiver's plane, the part before it counts.",
                       ["03-21 11:15", "01-21 13:15"],
                       [receiver(WINDOW), shade("Through",
                                                SOUTH.at((0.4, 1.2, -0.6), (1.0, 0.2, 0.8), (2.5, 0.4, 0.7)))]),
    "triangle": ("non-convex receivers", "A window that is a triangle.", ["03-21 11:15", "03-21 15:15"],
                 [receiver(SOUTH.shape([(0, 0), (3, 0), (1.2, 2)])), shade("Overhang", SOUTH.shelf(0.2, 1.9, 2, 1.1))]),
    "receiver-l": ("non-convex receivers", "A receiver in the shape of an L.", ["03-21 11:15", "01-21 13:15"],
                   [receiver(SOUTH.shape(L)), shade("Panel", SOUTH.rectangle(0.5, 1.2, 1.1, 1.6, 0.6))]),
    "receiver-star": ("non-convex receivers", "A star behind slats.", ["03-21 11:15", "01-21 09:15"],
                      [receiver(SOUTH.shape(STAR)),
                       shade("Slat", SOUTH.rectangle(-1.5, -1.0, 3, 0.15, 0.4), **copies(8, SOUTH.step(up=0.37)))]),
    "wall-around-window": ("thin receivers", "What a window leaves of its wall, a frame of 2 % of the width.",
                           ["03-21 11:15", "03-21 15:15"],
                           [receiver(SOUTH.rectangle(0, 0, 3, 3), holes=[SOUTH.rectangle(0.06, 0.06, 2.88, 2.88)]),
                            shade("Louvre", SOUTH.shelf(-1, 0.1, 5, 0.2, 0, 0.1), **copies(10, SOUTH.step(up=0.3)))]),
    "caster-l": ("non-convex casters", "A shade in the shape of an L.", ["03-21 11:15", "01-21 13:15"],
                 [receiver(SOUTH.rectangle(0, 0, 3, 3)), shade("L", SOUTH.shape(L, 0.7))]),
    "caster-u": ("non-convex casters", "A shade in the shape of a U.", ["03-21 11:15", "12-21 09:15"],
                 [receiver(SOUTH.rectangle(0, 0, 3, 3)),
                  shade("U", SOUTH.shape([(0.3, 0.5), (2.7, 0.5), (2.7, 2.8), (2.2, 2.8), (2.2, 1.2), (0.8, 1.2),
                                          (0.8, 2.8), (0.3, 2.8)], 0.9))]),
    "caster-star": ("non-convex casters", "Two stars, one before the other.", ["03-21 11:15", "01-21 13:15"],
                    [receiver(WINDOW),
                     shade("Star 1", SOUTH.shape([(1.5 + 1.1 * x, 0.75 + 1.1 * y) for x, y in STAR], 1.0)),
                     shade("Star 2", SOUTH.shape([(1.7 + x, 1.6 + y) for x, y in STAR], 1.4))]),
    "ring": ("holes", "A shade with a hole.", ["03-21 11:15", "01-21 13:15"],
             [receiver(SOUTH.rectangle(0, 0, 3, 3)),
              shade("Ring",
                    SOUTH.rectangle(0.2, 0.4, 2.5, 2.5, 0.8), holes=[SOUTH.rectangle(0.8, 1.0, 1.2, 1.1, 0.8)])]),
    "plate-25": ("holes", "A thin plate with 25 square holes.", ["03-21 11:15", "01-21 13:15", "12-21 15:15"],
                 [receiver(SOUTH.rectangle(0, 0, 3, 3)),
                  shade("Plate", SOUTH.rectangle(0, 0, 3, 3, 0.5), holes=plate(5, 5, 0.3, 0.5, 0.5))]),
    "plate-thick": ("holes", "Nine square holes with thickness: two faces and the walls between.",
                    ["01-21 13:15", "12-21 11:15"], [receiver(SOUTH.rectangle(0, 0, 3, 3)), *thick_plate()]),
    "plates-two": ("layers", "Two thin plates with holes, one behind the other.", ["01-21 13:15", "12-21 11:15"],
                   [receiver(SOUTH.rectangle(0, 0, 3, 3)),
                    shade("Outer", SOUTH.rectangle(0, 0, 3, 3, 0.9), holes=plate(5, 5, 0.4, 0.5, 0.9)),
                    shade("Inner", SOUTH.rectangle(0, 0, 3, 3, 0.4), holes=plate(6, 6, 0.3, 0.42, 0.4))]),
    "rectangles-13": ("overlaps", "13 rectangles, one before the other: stock EnergyPlus runs out of figures.",
                      ["03-21 11:15", "01-21 13:15"],
                      [receiver(SOUTH.rectangle(0, 0, 3, 3)),
                       *[shade(f"Rectangle {i}",
                               SOUTH.rectangle(0.1 * i, 0.5 + 0.13 * ((5 * i) % 13), 1.3, 0.9, 0.3 + 0.1 * i))
                         for i in range(13)]]),
    "slats-1mm": ("thin casters", "200 slats of 1 mm.", ["03-21 11:15", "01-21 13:15"],
                  [receiver(WINDOW), shade("Slat", SOUTH.rectangle(-0.5, 0.002, 4, 0.001, 0.05),
                                           **copies(200, SOUTH.step(up=0.0075)))]),
    "slats-4mm": ("thin casters", "150 slats of 4 mm.", ["03-21 11:15", "01-21 13:15"],
                  [receiver(WINDOW), shade("Slat", SOUTH.rectangle(-0.5, 0.003, 4, 0.004, 0.05),
                                           **copies(150, SOUTH.step(up=0.01)))]),
    "slats-40mm": ("thin casters", "15 slats of 40 mm.", ["03-21 11:15", "01-21 13:15"],
                   [receiver(WINDOW), shade("Slat", SOUTH.rectangle(-0.5, 0.03, 4, 0.04, 0.3),
                                            **copies(15, SOUTH.step(up=0.1)))]),
    "louvre-1": ("many casters", "One louvre.", ["03-21 11:15", "01-21 13:15"],
                 [receiver(WINDOW), shade("Louvre", SOUTH.shelf(-0.2, 0.8, 3.4, 0.3, 0.1, 0.05))]),
    "louvres-20": ("many casters", "20 louvres.", ["03-21 11:15", "12-21 09:15"],
                   [receiver(WINDOW), shade("Louvre", SOUTH.shelf(-0.2, 0.07, 3.4, 0.08, 0.03, 0.05),
                                            **copies(20, SOUTH.step(up=0.075)))]),
    "louvres-100": ("many casters", "100 louvres.", ["01-21 13:15", "12-21 11:15"],
                    [receiver(WINDOW), shade("Louvre", SOUTH.shelf(-0.2, 0.01, 3.4, 0.013, 0.003, 0.02),
                                             **copies(100, SOUTH.step(up=0.015)))]),
    "louvres-1000": ("many casters", "1,000 louvres.", ["12-21 11:15"],
                     [receiver(WINDOW), shade("Louvre", SOUTH.shelf(-0.2, 0.001, 3.4, 0.0013, 0.0003, 0.01),
                                              **copies(1000, SOUTH.step(up=0.0015)))]),
    "louvres-two-layers": ("layers", "Louvres of two pitches, one layer before the other.",
                           ["01-21 13:15", "12-21 11:15"],
                           [receiver(WINDOW),
                            shade("Outer", SOUTH.rectangle(-1, -0.5, 5, 0.05, 0.6), **copies(31, SOUTH.step(up=0.1))),
                            shade("Inner", SOUTH.rectangle(-1, -0.5, 5, 0.03, 0.3), **copies(46,
                                                                                             SOUTH.step(up=0.067)))]),
    "egg-crate": ("layers", "An egg-crate of 12 blades and 20 fins.", ["03-21 11:15", "01-21 13:15"],
                  [receiver(WINDOW), shade("Blade", SOUTH.shelf(0, 0.06, 3, 0.1, 0, 0.02), **copies(12,
                                                                                                    SOUTH.step(up=0.125))),
                   shade("Fin", SOUTH.fin(0.08, 0, 1.5, 0.1, 0.02), **copies(20, SOUTH.step(right=0.15)))]),
    "roof-chimney": ("tilted receivers", "A sloped roof with a chimney.", ["03-21 11:15", "12-21 15:15"],
                     [receiver(roof.rectangle(0, 0, 6, 4)),
                      *[shade(f"Chimney {k}", face) for k, face in enumerate(
                          [[x + 2.0, y + 1.5, z] for x, y, z in face] for face in box(0.2, 0.1, 0.8, 0.6, 3.0))]]),
    "roof-window-louvres": ("tilted receivers", "A window in a roof that faces south-west, behind louvres.",
                            ["03-21 15:15", "06-21 11:15"],
                            [receiver(Facade(215, 40).rectangle(0, 0, 1.2, 1.6)),
                             shade("Louvre", Facade(215, 40).shelf(-0.1, 0.1, 1.4, 0.15, 0, 0.03),
                                   **copies(9, Facade(215, 40).step(up=0.18)))]),
    "flat-roof-parapet": ("tilted receivers", "A flat roof within a parapet.", ["03-21 11:15", "12-21 15:15"],
                          [receiver([[0, 0, 0], [8, 0, 0], [8, 5, 0], [0, 5, 0]]),
                           *[shade(f"Parapet {k}", face) for k, face in enumerate(box(0, 0, 8, 5, 0.7)[:4])]]),
    "turned-37": ("tilted receivers", "Louvres before a wall that faces 217 degrees.", ["03-21 15:15", "01-21 13:15"],
                  turned(217)),
    "site-500-km": ("far and large", "Louvres on a site 500 km east and 4,000 km north of the origin.",
                    ["03-21 11:15", "01-21 13:15"],
                    [receiver(Facade(origin=far).rectangle(0, 0, 3, 1.5)),
                     shade("Louvre", Facade(origin=far).shelf(-0.2, 0.1, 3.4, 0.12, 0.05, 0.05),
                           **copies(15, SOUTH.step(up=0.1)))]),
    "tower-1-km": ("far and large", "A tower 1 km away.", ["12-21 15:15"],
                   [receiver(SOUTH.rectangle(0, 0, 6, 12)),
                    *[shade(f"Tower {k}", face) for k, face in enumerate(box(-713.5, -716.0, 9.0, 9.0, 211.0))]]),
    "low-sun-fins": ("low sun", "Fins at a sun of a third of a degree.", [LOW_SUN],
                     [receiver(WINDOW), shade("Fin", SOUTH.fin(0.1, -0.5, 2.5, 0.1, 0.02), **copies(10,
                                                                                                    SOUTH.step(right=0.3)))]),
    "low-sun-hill": ("low sun", "A wall 12 m high, 900 m away, at a sun of a third of a degree.", [LOW_SUN],
                     [receiver(SOUTH.rectangle(0, 0, 3, 8)),
                      shade("Wall", SOUTH.rectangle(-1300, 0, 900, 9, 480.0))]),
    "grazing-wall": ("low sun", "The sun stands 0.14 degrees before a wall's plane.", [WEST_SUN],
                     [receiver(Facade(191.855).rectangle(0, 0, 3, 2)),
                      shade("Fin", Facade(191.855).fin(-5, -20, 40, 0.015))]),
    "glass-part": ("glass", "A pane of transmittance 0.3 before a part of a window.", ["03-21 11:15", "01-21 13:15"],
                   [receiver(WINDOW), shade("Pane", SOUTH.rectangle(0.5, 0.8, 1.6, 1.5, 0.5), transmittance=0.3)]),
    "glass-two": ("glass", "Two panes whose shadows overlap.", ["03-21 11:15", "01-21 13:15"],
                  [receiver(WINDOW), shade("Pane 1", SOUTH.rectangle(0.3, 0.6, 1.6, 1.5, 0.5), transmittance=0.5),
                   shade("Pane 2", SOUTH.rectangle(1.1, 0.7, 1.7, 1.7, 0.7), transmittance=0.6)]),
    "glass-and-opaque": ("glass", "A pane, partly behind an opaque panel.", ["03-21 11:15", "01-21 13:15"],
                         [receiver(WINDOW), shade("Pane", SOUTH.rectangle(0.3, 0.6, 1.6, 1.5, 0.5), transmittance=0.5),
                          shade("Panel", SOUTH.rectangle(1.0, 0.9, 1.2, 1.2, 0.9))]),
    "glass-louvres": ("glass", "40 louvres of transmittance 0.6.", ["03-21 11:15", "12-21 09:15"],
                      [receiver(WINDOW), shade("Louvre", SOUTH.shelf(-0.2, 0.05, 3.4, 0.08, 0.03, 0.05),
                                               transmittance=0.6,
                                               **copies(40, SOUTH.step(up=0.0375)))]),
    "shades-share-an-edge": ("shades that touch", "No light passes between shades that share an edge.",
                             ["03-21 11:15", "01-21 13:15"],
                             [receiver(WINDOW),
                              *[shade(f"Panel {k}", SOUTH.rectangle(0.3 * k, 0.4, 0.3, 1.2, 0.5)) for k in range(8)]]),
    "shade-does-not-cast": ("overhangs", "A surface that casts no shadow.", ["03-21 11:15"],
                            [receiver(WINDOW), shade("Overhang", SOUTH.shelf(-1, 1.8, 5, 1.0)),
                             shade("Ghost", SOUTH.rectangle(-1, -1, 5, 5, 0.5), casts=False)]),
}


def polygon(random_, size):
    """A polygon around the origin, which need not be convex."""
    count = random_.randint(3, 7)
    angles = sorted(random_.uniform(0, 2 * math.pi) for _ in range(count))
    if max((b - a) % (2 * math.pi) for a, b in zip(angles, angles[1:] + angles[:1], strict=True)) > 0.9 * math.pi:
        return polygon(random_, size)
    radii = [size * random_.uniform(0.3, 1) for _ in angles]
    return [(r * math.cos(a), r * math.sin(a)) for a, r in zip(angles, radii, strict=True)]


def random_scene(number):
    """Polygons of any tilt between the receiver and one of the suns, some of them glass in every third scene."""
    random_ = random.Random(SEED + number)
    facade = Facade(random_.uniform(120, 240), random_.choice([90, 90, random_.uniform(10, 80)]))
    facing = [sun for sun, place in SUNS.items() if exact.towards(*place) @ facade.out > 0.15]
    suns = random_.sample(facing, 2)
    shapes = [[(0, 0), (3, 0), (3, 2), (0, 2)], L, [(0, 0), (3, 0), (1, 2)],
              [(1.5 + 1.5 * x, 1.0 + y) for x, y in STAR]]
    surfaces = [receiver(facade.shape(random_.choice(shapes)))]
    for k in range(random_.choice([3, 8, 20])):
        towards_sun = exact.towards(*SUNS[random_.choice(suns)])
        at = facade.at((random_.uniform(0, 3), random_.uniform(0, 2), 0))[0] + random_.uniform(0.3, 4) * towards_sun
        tilted = Facade(random_.uniform(0, 360), random_.uniform(0, 180), at)
        glass = number % 3 == 0 and random_.random() < 0.6
        more = {"transmittance": round(random_.uniform(0.1, 0.9), 3)} if glass else {}
        surfaces.append(shade(f"Shade {k + 1}", tilted.shape(polygon(random_, random_.uniform(0.2, 1.0))), **more))
    return {"scene": f"random-{number:02}", "feature": "random", "tests": "Random polygons at random places.",
            "source": f"random seed {SEED + number}", "tolerance": 1e-6, "surfaces": surfaces, "suns": suns}


def text_of(scene):
    """JSON with a line for each surface and each sun."""
    def lines(key):
        return ",\n".join(f"    {json.dumps(entry)}" for entry in scene[key])

    head = "".join(f"  {json.dumps(key)}: {json.dumps(value)},\n" for key, value in scene.items()
                   if key not in ("surfaces", "suns"))
    return f'{{\n{head}  "surfaces": [\n{lines("surfaces")}\n  ],\n  "suns": [\n{lines("suns")}\n  ]\n}}\n'


def answers(scene):
    """For each sun, that of each receiver."""
    surfaces = exact.surfaces_of(scene)
    for sun in scene["suns"]:
        direction = exact.towards(sun["azimuth"], sun["altitude"])
        found = {}
        for one in surfaces:
            if one.receives:
                values = [method(surfaces, one, direction) for method in (exact.by_overlay, exact.by_slabs)]
                if abs(values[0] - values[1]) > AGREE:
                    raise SystemExit(f"{scene['scene']}, {sun['time']}, {one.name}: {values[0]!r} and {values[1]!r}")
                found[one.name] = round(float(sum(values)) / 2, 12)
        yield {**sun, "sunlit": found}


def write(scene):
    scene["suns"] = [sun if isinstance(sun, dict) else
                     {"time": sun, "azimuth": SUNS[sun][0], "altitude": SUNS[sun][1]} for sun in scene["suns"]]
    scene["suns"] = list(answers(scene))
    (FOLDER / "scenes" / f"{scene['scene']}.json").write_text(text_of(scene), encoding="utf-8")
    print(scene["scene"], [sun["sunlit"] for sun in scene["suns"]])


def main():
    if "--answers-only" not in sys.argv[1:]:
        for name, (feature, tests, suns, surfaces) in CLOSED.items():
            write({"scene": name, "feature": feature, "tests": tests, "source": "made for the suite", "tolerance": 1e-6,
                   "surfaces": surfaces, "suns": suns})
        for number in range(1, 23):
            write(random_scene(number))
    else:
        for file in sorted((FOLDER / "scenes").glob("*.json")):
            write(json.loads(file.read_text(encoding="utf-8")))


if __name__ == "__main__":
    main()
