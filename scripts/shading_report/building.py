"""Drawings of the building with its receivers numbered, from the scene that gpu_shading check prints."""

import json
import math
import subprocess
from dataclasses import dataclass
from xml.sax.saxutils import escape

import matplotlib as mpl

DIRECTIONS = ((150.0, 32.0), (330.0, 32.0))  # where they are seen from: azimuth from north and altitude, degrees
WIDTH = 640
MAX_CASTERS = 1500  # the largest
MAX_NUMBERS = 99
RADIUS = 9  # of a number's disc


@dataclass
class Surface:
    """A polygon with holes; number: of a receiver, from 1, with its mean sunlit fraction or None.

    One-sided: a face of a body, seen from outside alone.
    """

    rings: list
    number: int = 0
    name: str = ""
    sunlit: float | None = None
    is_one_sided: bool = False


def _scene(run, weather):
    """(surfaces as gpu_shading check tells them, '') or (None, why not)."""
    command = [run.program.parent / "gpu_shading", "check", "--json", "--vertices", run.placed, "-w", weather]
    if run.extension_file:
        command += ["--gpu-shading-file", run.extension_file]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL)
    if done.returncode:
        return None, (done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1]
    return json.loads(done.stdout)["surfaces"], ""


def _newell(ring):
    """The normal of a ring; as long as twice its area."""
    normal = [0.0, 0.0, 0.0]
    for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
        for axis, (i, k) in enumerate(((1, 2), (2, 0), (0, 1))):
            normal[axis] += (a[i] - b[i]) * (a[k] + b[k])
    return normal


def _dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def surfaces_of(scene, receivers):
    """receivers: {name: (number, mean sunlit fraction)}. All of them, and the largest of the others."""
    found, casters = [], []
    bodies = {surface["name"] for surface in scene if surface["receives"]}
    for surface in scene:
        rings = [surface["outline"], *surface["holes"]]
        if surface["name"] in bodies and not surface["receives"]:
            continue  # a copy of a wall, without its openings
        if surface["name"] in receivers:
            number, sunlit = receivers[surface["name"]]
            found.append(Surface(rings, number, surface["name"], sunlit, is_one_sided=True))
        elif surface["casts"] != "never" or surface["receives"]:
            casters.append(Surface(rings, name=surface["name"], is_one_sided=surface["receives"]))
    casters.sort(key=lambda caster: -math.hypot(*_newell(caster.rings[0])))
    return found + casters[:MAX_CASTERS]


class _View:
    """A parallel projection, fitted to the receivers."""

    def __init__(self, surfaces, azimuth, altitude):
        a, h = math.radians(azimuth), math.radians(altitude)
        self.towards = (math.sin(a) * math.cos(h), math.cos(a) * math.cos(h), math.sin(h))
        self.right = (-math.cos(a), math.sin(a), 0.0)
        self.up = (-math.sin(a) * math.sin(h), -math.cos(a) * math.sin(h), math.cos(h))
        flat = [self.flat(point) for surface in surfaces if surface.number for point in surface.rings[0]]
        lows, highs = [[extreme(values) for values in zip(*flat, strict=True)] for extreme in (min, max)]
        margin = 0.12 * max(highs[0] - lows[0], highs[1] - lows[1])
        self.left, self.top = lows[0] - margin, highs[1] + margin
        self.scale = WIDTH / (highs[0] - lows[0] + 2 * margin)
        self.height = round(self.scale * (highs[1] - lows[1] + 2 * margin))

    def flat(self, point):
        return _dot(point, self.right), _dot(point, self.up)

    def position(self, point):
        """Pixels from the upper left corner."""
        x, y = self.flat(point)
        return self.scale * (x - self.left), self.scale * (self.top - y)

    def depth(self, surface):
        ring = surface.rings[0]
        return sum(_dot(point, self.towards) for point in ring) / len(ring)


def _path(view, surface):
    parts = []
    for ring in surface.rings:
        positions = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(view.position, ring))
        parts.append(f"M{positions}Z")
    return "".join(parts)


def _is_inside(position, rings):
    """By the odd-even rule, rings of positions in a drawing."""
    x, y = position
    inside = False
    for ring in rings:
        for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1], strict=True):
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                inside = not inside
    return inside


def _distance(position, rings):
    """To the nearest edge."""
    x, y = position
    nearest = math.inf
    for ring in rings:
        for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1], strict=True):
            length = (bx - ax) ** 2 + (by - ay) ** 2
            share = 0.0 if length == 0 else min(1.0, max(0.0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length))
            nearest = min(nearest, math.hypot(x - ax - share * (bx - ax), y - ay - share * (by - ay)))
    return nearest


def _box(rings):
    return [extreme(values) for extreme in (min, max) for values in zip(*rings[0], strict=True)]


def _label(rings, nearer):
    """A position on a surface for its number, away from edges and not behind nearer surfaces; None: there is none."""
    left, top, right, bottom = _box(rings)
    hiding = [other for other, (low_x, low_y, high_x, high_y) in nearer
              if low_x < right and high_x > left and low_y < bottom and high_y > top]
    steps = 9
    free = []
    for i in range(1, steps):
        for k in range(1, steps):
            position = (left + (right - left) * i / steps, top + (bottom - top) * k / steps)
            if _is_inside(position, rings) and not any(_is_inside(position, other) for other in hiding):
                free.append((min(_distance(position, each) for each in (rings, *hiding)), position))
    return max(free)[1] if free else None


def _draw(view, surfaces, compass):
    parts = [f'<svg class="building" viewBox="0 0 {WIDTH} {view.height}" role="img" '
             f'aria-label="The building from the {compass}, receivers numbered">']
    labels, nearer = [], []
    facing = [surface for surface in surfaces
              if not surface.is_one_sided or _dot(_newell(surface.rings[0]), view.towards) > 0]
    for surface in sorted(facing, key=view.depth, reverse=True):
        rings = [[view.position(point) for point in ring] for ring in surface.rings]
        fill = mpl.colors.to_hex(mpl.colormaps["cividis"](surface.sunlit)) if surface.sunlit is not None else "#d5d0c6"
        parts.insert(1, f'<path d="{_path(view, surface)}" fill="{fill}" fill-rule="evenodd">'
                        f"<title>{escape(surface.name)}</title></path>")
        if surface.number and (position := _label(rings, nearer)):
            labels.append(f'<circle cx="{position[0]:.1f}" cy="{position[1]:.1f}" r="{RADIUS}"/>'
                          f'<text x="{position[0]:.1f}" y="{position[1] + 3.5:.1f}">{surface.number}</text>')
        nearer.append((rings, _box(rings)))
    return "\n".join([*parts, *labels, "</svg>"])


def draw(runs, weather, receivers):
    """(SVG elements, '') with receivers {name: (number, mean sunlit fraction)}, or ([], why there are none)."""
    ours = next((run for run in runs if run.is_ours), None)
    if not ours:
        return [], "none of these runs was rendered by this software"
    scene, reason = _scene(ours, weather)
    if reason:
        return [], reason
    surfaces = surfaces_of(scene, receivers)
    if not any(surface.number for surface in surfaces):
        return [], "no receiver is in the scene"
    words = ("south-east", "north-west")
    return [_draw(_View(surfaces, *direction), surfaces, word)
            for direction, word in zip(DIRECTIONS, words, strict=True)], ""
