"""The answers of the suite's scenes, by both exact methods and by closed forms, and those of this renderer."""

import json
import math
from pathlib import Path

import exact
import pytest

import gpu_shading

SCENES = sorted((Path(__file__).parent / "scenes").glob("*.json"))


def read(path):
    scene = json.loads(path.read_text(encoding="utf-8"))
    assert scene["scene"] == path.stem
    return scene


def receivers_of(scene):
    """(surfaces, receiver, unit vector to the sun, answer) of each answer."""
    surfaces = exact.surfaces_of(scene)
    for sun in scene["suns"]:
        for receiver in surfaces:
            if receiver.receives:
                yield surfaces, receiver, exact.towards(sun["azimuth"], sun["altitude"]), sun["sunlit"][receiver.name]


def test_there_are_scenes_of_all_sources():
    sources = [read(path)["source"] for path in SCENES]
    assert len(SCENES) >= 60
    assert sum("issue" in source for source in sources) >= 20
    assert sum("random seed" in source for source in sources) >= 20


@pytest.mark.parametrize("method", [exact.by_overlay, exact.by_slabs])
def test_answers_are_those_of_both_methods(method):
    pytest.importorskip("shapely", reason="shapely could not be fetched (scripts/setup)")
    for path in SCENES:
        for surfaces, receiver, sun, answer in receivers_of(read(path)):
            assert method(surfaces, receiver, sun) == pytest.approx(answer, abs=1e-9), path.stem


def shift(sun, out):
    """How far a shadow is moved on a wall that faces south, to the right and up, from so far before it."""
    return -out * sun[0] / -sun[1], -out * sun[2] / -sun[1]


def overlap(a, b):
    """The common area of rectangles (x, y, width, height)."""
    across = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    along = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    return max(0.0, across) * max(0.0, along)


def common(a, b):
    x, y = max(a[0], b[0]), max(a[1], b[1])
    return x, y, max(0.0, min(a[0] + a[2], b[0] + b[2]) - x), max(0.0, min(a[1] + a[3], b[1] + b[3]) - y)


def moved(rectangle, sun, out):
    x, y = shift(sun, out)
    return rectangle[0] + x, rectangle[1] + y, *rectangle[2:]


def slats_40mm(sun):
    window = (0, 0, 3, 1.5)
    return 1 - sum(overlap(window, moved((-0.5, 0.03 + 0.1 * k, 4, 0.04), sun, 0.3)) for k in range(15)) / 4.5


def glass_two(sun):
    window = (0, 0, 3, 1.5)
    one = common(window, moved((0.3, 0.6, 1.6, 1.5), sun, 0.5))
    other = common(window, moved((1.1, 0.7, 1.7, 1.7), sun, 0.7))
    both = overlap(one, other)
    areas = (one[2] * one[3] - both, other[2] * other[3] - both, both)
    return 1 - sum(area * (1 - share) for area, share in zip(areas, (0.5, 0.6, 0.3), strict=True)) / 4.5


def ring(sun):
    wall = (0, 0, 3, 3)
    return 1 - (overlap(wall, moved((0.2, 0.4, 2.5, 2.5), sun, 0.8))
                - overlap(wall, moved((0.8, 1.0, 1.2, 1.1), sun, 0.8))) / 9


def overhang_wide(sun):
    """The profile angle alone, where the shadow's ends are beside the window."""
    across, down = shift(sun, 1)
    return None if abs(across) > 1 else 1 - min(1.5, max(0.0, -down - 0.3)) / 1.5


def low_sun_hill(sun):
    _, down = shift(sun, 480)
    return 1 - min(8, max(0.0, 9 + down)) / 8


@pytest.mark.parametrize("form", [slats_40mm, glass_two, ring, overhang_wide, low_sun_hill])
def test_answers_are_closed_forms(form):
    path = next(path for path in SCENES if path.stem == form.__name__.replace("_", "-"))
    compared = [(answer, form(sun)) for _, _, sun, answer in receivers_of(read(path)) if form(sun) is not None]
    assert compared
    for answer, expected in compared:
        assert answer == pytest.approx(expected, abs=1e-9)


def test_this_renderer_is_within_its_target():
    """And exact where it takes no samples."""
    off = {}
    for path in SCENES:
        scene = read(path)
        surfaces = exact.surfaces_of(scene)
        made = gpu_shading.Scene()
        for surface in surfaces:
            made.add(surface.rings[0], name=surface.name, holes=surface.rings[1:], receives=surface.receives,
                     casts="always" if surface.casts else "never", transmittance=surface.transmittance or None)
        found = made.sunlit([[sun["azimuth"], sun["altitude"]] for sun in scene["suns"]], device="cpu")
        off[path.stem] = max(abs(value - answer) for row, sun in zip(found, scene["suns"], strict=True)
                             for value, answer in zip(row, sun["sunlit"].values(), strict=True))
    assert max(off.values()) < 1e-3
    assert sum(error > 1e-6 for error in off.values()) <= 5, sorted(off.items(), key=lambda item: -item[1])[:8]


def test_the_sun_is_where_energyplus_has_it():
    """By the hour angle and declination of its tables at latitude 40."""
    suns = json.loads((Path(__file__).parent / "suns.json").read_text())
    for time, (azimuth, altitude) in suns.items():
        x, y, z = exact.towards(azimuth, altitude)
        latitude = math.radians(40)
        declination = math.degrees(math.asin(math.sin(latitude) * z + math.cos(latitude) * y))
        expected = {"01": -19.9, "03": 0.2, "06": 23.4, "09": 0.6, "12": -23.4}[time[:2]]
        assert declination == pytest.approx(expected, abs=0.5), time


