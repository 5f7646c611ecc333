"""EnergyPlus models: the surfaces that take part in shading, and the scene that is rendered."""

from __future__ import annotations

import html
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gpu_shading import _html, _programs
from gpu_shading._reading import reading
from gpu_shading._text import one_line
from gpu_shading.crown import Crown
from gpu_shading.errors import RunError
from gpu_shading.optics import Screen, Transmittance

_FORMATS = ("gpu_shading check 1", "gpu_shading scene 1")


class Check(dict[str, Any]):
    """The result of check(): a dictionary that shows its surfaces in a notebook."""

    def _repr_html_(self) -> str:
        columns = ("name", "kind", "area", "receives", "casts")
        return "".join(f"<p>{html.escape(line)}</p>" for line in self["remarks"]) + _html.table(
            columns, ([surface[column] for column in columns] for surface in self["surfaces"]))


def check(model: _programs.Name, weather: _programs.Name | None = None) -> Check:
    """How each surface of an IDF or epJSON file takes part in the shading calculation, as `gpu_shading check --json`
    prints it: "surfaces", each with "name", "kind", "area" (m2), "receives" and "casts", and "remarks" and "rule".
    EnergyPlus runs up to its shading calculation. An error in the model raises RunError."""
    return Check(_document(model, weather, [], _FORMATS[0]))


@dataclass(frozen=True)
class Contents:
    """The parts of a scene."""

    error: float
    resolution: int | None
    schedules: list[str]
    deployments: list[str]
    surfaces: list[dict[str, Any]]
    """Arguments of Scene.add for each."""
    rule: tuple[NDArray[Any], NDArray[Any]] | None
    """Roles, and which zone shades which."""


def read(model: _programs.Name, weather: _programs.Name | None = None,
         extensions: _programs.Name | None = None) -> Contents:
    """The scene that is rendered for a model. `extensions`: a side file in place of the model's own."""
    side_file = None if extensions is None else _programs.file(extensions, "extensions")
    document = _document(model, weather, ["--vertices", *_programs.flags(gpu_shading_file=side_file)], _FORMATS[1])
    with reading(Path(model), "a model whose scene this package can read"):
        return _contents(document)


def _contents(document: dict[str, Any]) -> Contents:
    shades = [Transmittance.table(np.linspace(0.0, 90.0, len(values)), values) for values in document["transmittances"]]
    screens = [_screen(found) for found in document["screens"]]
    schedules, deployments = document["schedules"], document["deployments"]

    def item(among: list[Any], index: int | None) -> Any:
        return None if index is None or index < 0 else among[index]

    surfaces = [
        {"vertices": surface["outline"], "holes": surface["holes"], "name": surface["name"],
         "receives": surface["receives"], "casts": surface["casts"],
         "transmittance": item(shades, surface["transmittance"]), "screen": item(screens, surface["screen"]),
         "screen_origin": tuple(surface["origin"]), "screen_rotation": surface["rotation"],
         "schedule": item(schedules, surface["schedule"]), "deployment": item(deployments, surface["deployment"]),
         "crown": Crown(**surface["crown"]) if surface["crown"] else None}
        for surface in document["surfaces"]]
    rule, zones = document["rule"], document["rule"]["zones"]
    return Contents(document["error"], document["resolution"], schedules, deployments, surfaces,
                    (np.array(rule["roles"]), np.array(rule["zone_shades"]).reshape(zones, zones))
                    if rule["roles"] else None)


def _document(model: _programs.Name, weather: _programs.Name | None, flags: list[str], format_: str) -> dict[str, Any]:
    text = _programs.gpu_shading(["check", "--json", *flags, *_programs.inputs(model, weather)])
    try:
        document = json.loads(text)
        found = document.get("format")
    except (AttributeError, RecursionError, ValueError):
        found = one_line(text[:200])
    if found != format_:
        raise RunError(f"the gpu_shading program writes {found!r}, expected {format_!r}: it is of another version than "
                       "this package")
    return dict(document)


def _screen(found: dict[str, Any]) -> Screen:
    if "pattern" in found:
        pattern = found["pattern"]
        return Screen.pattern(pattern["hole"], pattern["size"], pattern["pitch"], arrangement=pattern["arrangement"],
                              length=pattern["length"], row_pitch=pattern["row_pitch"], thickness=found["thickness"],
                              plane=found["plane"], detail=found["detail"])
    tile = found["tile"]
    texels = np.frombuffer(bytes.fromhex(tile["opacity"]), dtype=">u2").astype(np.uint16)
    return Screen.from_texels(texels.reshape(tile["rows"], tile["columns"]), tile["width"], tile["height"],
                              threshold=tile["threshold"], thickness=found["thickness"], plane=found["plane"],
                              layers=found["layers"], detail=found["detail"])
