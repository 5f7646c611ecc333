"""What mismatch costs, as a picture: the field of modules, and a string by day and hour."""

from __future__ import annotations

import html
from typing import Any

import numpy as np

from gpu_shading._arrays import Floats

# From dark blue to yellow, legible with any kind of colour vision: after cividis (Nunez, Anderton & Renslow 2018).
_COLOURS = np.array([[0, 34, 78], [66, 78, 108], [124, 123, 120], [187, 174, 108], [254, 232, 56]], float)
_FIELD = 900.0  # pixels
_TALLEST = 40.0  # of a module
_HOUR = 14.0


def draw(power: Any, string: int = 0) -> str:
    """An SVG of a pv.Power: each module by the share of its energy that mismatch takes, and the share of a string's
    power by day and hour."""
    shapes: list[str] = []
    lost = _share(power.module_with.sum(axis=0), power.module_without.sum(axis=0))
    most = max(float(lost.max()), 1e-3)
    columns, rows = power.positions.max(axis=0) + 1
    wide, tall = min(_FIELD / columns, 0.7 * _TALLEST * 3), min(_TALLEST, _FIELD / columns * 1.6)
    top = 70.0
    for (column, row), share in zip(power.positions, lost, strict=True):
        _box(shapes, 60 + wide * column, top + tall * (rows - 1 - row), 0.94 * wide, 0.94 * tall, share / most,
             f"{share:.1%}")
    under = top + tall * rows + 50
    days = (power.times.astype("datetime64[D]") - power.times.astype("datetime64[D]").min()).astype(int)
    day = min(_FIELD / (int(days.max()) + 1), 30.0)
    first = int(power.clock[:, 2].min())
    whole = power.string_without[:, string]
    step = _HOUR / power.steps_per_hour
    for i in np.flatnonzero(whole > 0):
        hour, part = power.clock[i, 2:]
        share = float(_share(power.string_with[i:i + 1, string], whole[i:i + 1])[0])
        _box(shapes, 60 + day * int(days[i]), under + _HOUR * int(hour - first) + step * int(part - 1), day + 0.3,
             step + 0.3, share, f"{share:.1%}")
    last = int(power.clock[:, 2].max())
    for hour in range(first, last + 1, 2):
        _text(shapes, 52, under + _HOUR * (hour - first) + 4, f"{hour - 1:02}:00", "end")
    _text(shapes, 60, 28, f"{power.name}: {power.loss:.1%} of {power.energy / (1 - power.loss):.0f} kWh is lost by "
                          "mismatch of cells", "start")
    _text(shapes, 60, 56, f"Modules by loss, yellow: none, dark: {most:.1%}", "start")
    _text(shapes, 60, under - 14, f"String {string + 1}, loss from {power.times[0]} to {power.times[-1]}, yellow: "
                                  "none, dark: all", "start")
    height = under + _HOUR * (last - first + 1) + 20
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{_FIELD + 90:.0f}" height="{height:.0f}" '
            f'font-family="sans-serif" font-size="13">{"".join(shapes)}</svg>')


def _share(left: Floats, whole: Floats) -> Floats:
    return np.asarray(np.clip(1.0 - left / np.maximum(whole, 1e-9), 0.0, 1.0))


def _box(shapes: list[str], x: float, y: float, width: float, height: float, lost: float, told: str) -> None:
    place = np.linspace(0.0, 1.0, len(_COLOURS))
    colour = ",".join(f"{np.interp(1.0 - lost, place, channel):.0f}" for channel in _COLOURS.T)
    shapes.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" fill="rgb({colour})">'
                  f"<title>{told}</title></rect>")


def _text(shapes: list[str], x: float, y: float, text: str, anchor: str) -> None:
    shapes.append(f'<text x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}">{html.escape(text)}</text>')
