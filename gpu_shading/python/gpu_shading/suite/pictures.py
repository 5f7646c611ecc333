"""Pictures of scenes on which tools are off: shadows on a receiver, and what each tool answers."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import numpy as np

from gpu_shading._arrays import Floats, unit_vectors
from gpu_shading._text import escaped
from gpu_shading.suite.scenes import Outline, Scene
from gpu_shading.suite.scores import Score

_SHADOW, _LIT = "#5f6b76", "#f2c14e"
_MARGIN = 0.15  # of the receiver's size
_MOST_LINED = 60  # casters


def draw(scene: Scene, scores: list[Score], temporary: Path) -> None:
    """A panel for each sun, of the receiver on which a tool is farthest off."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(4.4 * len(scene.suns), 5.0), layout="constrained")
    figure.suptitle(escaped(f"{scene.name}: {scene.tests}"), fontsize=9)
    panels = figure.subplots(1, len(scene.suns), squeeze=False)[0]
    for place, (panel, sun) in enumerate(zip(panels, scene.suns, strict=True)):
        name = max(scene.exact[place], key=lambda each, place=place: _error(scores, place, each))  # type: ignore[misc]
        receiver = next(outline for outline in scene.outlines if outline.receives and outline.name == name)
        _draw_shadows(panel, scene, receiver, sun)
        panel.set_title(escaped(f"{name}, sun at {sun[0]:.1f}, {sun[1]:.1f} degrees"), fontsize=9)
        lines = [f"{value:.6f}  {label}" for label, value in [
            ("exact", scene.exact[place][name]),
            *((escaped(score.tool.name), score.outcome.answers[place][name])
              for score in scores if score.outcome.answers is not None)]]
        panel.set_xlabel("\n".join(lines), fontsize=8, loc="left")
    figure.savefig(temporary, dpi=100, bbox_inches="tight")


def _error(scores: list[Score], place: int, name: str) -> float:
    return max((abs(score.outcome.answers[place][name] - score.scene.exact[place][name])
                for score in scores if score.outcome.answers is not None), default=0.0)


def _draw_shadows(panel: Any, scene: Scene, receiver: Outline, sun: tuple[float, float]) -> None:
    towards = unit_vectors(np.radians([sun]))[0]
    rings = [np.array(ring) for ring in receiver.rings]
    origin = rings[0][0]
    normal = _normal(rings[0])
    # To the right and up, as somebody outside sees it.
    right = np.cross([0.0, 0.0, 1.0], normal) if abs(normal[2]) < 0.999 else np.array([1.0, 0.0, 0.0])
    right /= np.linalg.norm(right)
    axes = np.array([right, np.cross(normal, right)])

    flat = [(ring - origin) @ axes.T for ring in rings]
    low, high = flat[0].min(axis=0), flat[0].max(axis=0)
    room = _MARGIN * float((high - low).max())
    panel.set(xlim=(low[0] - room, high[0] + room), ylim=(low[1] - room, high[1] + room), aspect="equal", xticks=[],
              yticks=[])
    _fill(panel, flat, _LIT, 1.0, 0.8)
    facing = float(towards @ normal)
    if facing <= 0.0:
        return
    casters = [outline for outline in scene.outlines if outline.casts and outline is not receiver]
    for caster in casters:
        shadow = []
        for ring in caster.rings:
            before = _before(np.array(ring) - origin, normal)
            if len(before) > 2:
                shadow.append((before - np.outer(before @ normal, towards) / facing) @ axes.T)
        if shadow:
            _fill(panel, shadow, _SHADOW, 0.6, 0.3 if len(casters) <= _MOST_LINED else 0.0)


def _normal(ring: Floats) -> Floats:
    vector: Floats = np.cross(ring - ring[0], np.roll(ring, -1, axis=0) - ring[0]).sum(axis=0)
    unit: Floats = vector / np.linalg.norm(vector)
    return unit


def _before(ring: Floats, normal: Floats) -> Floats:
    """The part of a ring before the plane through the origin, if it has more than what touches it."""
    heights = ring @ normal
    kept = []
    if heights.max() > 1e-9:
        for (a, h), (b, k) in itertools.pairwise([*zip(ring, heights, strict=True), (ring[0], heights[0])]):
            if h >= 0:
                kept.append(a)
            if (h >= 0) != (k >= 0):
                kept.append(a + h / (h - k) * (b - a))
    return np.array(kept)


def _fill(panel: Any, rings: list[Floats], colour: str, alpha: float, line: float) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Curve

    closed = Curve.make_compound_path(*(Curve(np.vstack([ring, ring[:1]]), closed=True) for ring in rings))
    panel.add_patch(PathPatch(closed, facecolor=colour, edgecolor="black", linewidth=line, alpha=alpha))
