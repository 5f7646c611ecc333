"""Scenes of the suite, as their files have them (tests/suite/README.md)."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gpu_shading._reading import reading, text_of
from gpu_shading.errors import InvalidInput

_MOST_BYTES = 1 << 24
_MOST_SURFACES = 100_000  # with copies

Point = tuple[float, float, float]
Answers = list[dict[str, float]]
"""For each sun, the sunlit fraction of each receiver, 0 to 1."""


@dataclass(frozen=True)
class Outline:
    """A surface, as it is drawn."""

    name: str
    receives: bool
    casts: bool
    rings: tuple[tuple[Point, ...], ...]


@dataclass(frozen=True)
class Scene:
    path: Path
    name: str
    feature: str
    tests: str
    source: str
    tolerance: float
    outlines: tuple[Outline, ...]
    suns: tuple[tuple[float, float], ...]
    """Azimuth clockwise from north, and altitude, degrees."""
    exact: Answers


def read(folder: Path) -> list[Scene]:
    """The scenes of a folder, by name. Raises InvalidInput, naming the file."""
    files = sorted(folder.glob("*.json"))
    if not files:
        raise InvalidInput(f"{folder}: has no scenes (*.json)")
    return [_scene(path) for path in files]


def _scene(path: Path) -> Scene:
    with reading(path, "a scene of the suite"):
        if path.stat().st_size > _MOST_BYTES:
            raise ValueError(f"is larger than {_MOST_BYTES >> 20} MiB")
        data = json.loads(text_of(path))
        outlines = tuple(outline for entry in data["surfaces"] for outline in _outlines(entry))
        if len(outlines) > _MOST_SURFACES:
            raise ValueError(f"has more than {_MOST_SURFACES} surfaces")
        names = [outline.name for outline in outlines if outline.receives]
        suns = tuple((_number(sun["azimuth"]), _number(sun["altitude"])) for sun in data["suns"])
        exact = [checked(sun["sunlit"], names) for sun in data["suns"]]
        return Scene(path, _text(data["scene"]), _text(data["feature"]), _text(data["tests"]), _text(data["source"]),
                     _number(data["tolerance"]), outlines, suns, exact)


def checked(values: Any, names: list[str]) -> dict[str, float]:
    """A fraction for each of these receivers. Raises ValueError."""
    if not isinstance(values, dict) or set(values) != set(names):
        raise ValueError(f"expected a fraction for each of {', '.join(names)}")
    return {name: _number(values[name]) for name in names}


def _outlines(entry: Any) -> list[Outline]:
    rings = [[_point(point) for point in ring] for ring in [entry["vertices"], *entry.get("holes", [])]]
    copies = entry.get("copies", {"count": 1, "step": [0, 0, 0]})
    count, step = copies["count"], _point(copies["step"])
    if not isinstance(count, int) or not 1 <= count <= _MOST_SURFACES:
        raise ValueError(f"copies: expected a count of 1 to {_MOST_SURFACES}")
    return [Outline(entry["name"] if count == 1 else f"{entry['name']} {k + 1}", bool(entry.get("receives", False)),
                    bool(entry.get("casts", True)),
                    tuple(tuple((x + k * step[0], y + k * step[1], z + k * step[2]) for x, y, z in ring)
                          for ring in rings))
            for k in range(count)]


def _point(values: Any) -> Point:
    x, y, z = values
    return _number(x), _number(y), _number(z)


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ValueError("expected a number")
    return float(value)


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise ValueError("expected a text")
    return value
