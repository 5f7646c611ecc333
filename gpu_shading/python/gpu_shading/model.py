"""Models of EnergyPlus: what takes part in their shading calculation, and the scene that is rendered for them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gpu_shading import _programs
from gpu_shading.errors import RunError
from gpu_shading.optics import Screen, Transmittance

if TYPE_CHECKING:
    from gpu_shading.scene import Scene

_FORMATS = ("gpu_shading check 1", "gpu_shading scene 1")


def check(model: _programs.Name, weather: _programs.Name | None = None) -> dict[str, Any]:
    """How each surface of an IDF or epJSON file takes part in the shading calculation, as `gpu_shading check --json`
    tells it: "surfaces", each with "name", "kind", "area" (m2), "receives" and "casts", and "remarks" and "rule".
    EnergyPlus runs up to its shading calculation. An error of the model is a RunError."""
    return _document(model, weather, [], _FORMATS[0])


def read_scene(model: _programs.Name, weather: _programs.Name | None = None) -> Scene:
    """Scene.from_energyplus."""
    from gpu_shading.scene import Rule, Scene

    document = _document(model, weather, ["--vertices"], _FORMATS[1])
    shades = [Transmittance.table(np.linspace(0.0, 90.0, len(values)), values) for values in document["transmittances"]]
    screens = [_screen(found) for found in document["screens"]]
    schedules, deployments = document["schedules"], document["deployments"]
    scene = Scene(error=document["error"], resolution=document["resolution"])
    # In their order, which is that of factors, whichever surface comes first.
    scene.schedules[:], scene.deployments[:] = schedules, deployments

    def item(among: list[Any], index: int | None) -> Any:
        return None if index is None or index < 0 else among[index]

    for surface in document["surfaces"]:
        scene.add(
            surface["outline"], holes=surface["holes"], name=surface["name"], receives=surface["receives"],
            casts=surface["casts"], transmittance=item(shades, surface["transmittance"]),
            screen=item(screens, surface["screen"]), screen_origin=tuple(surface["origin"]),
            screen_rotation=surface["rotation"], schedule=item(schedules, surface["schedule"]),
            deployment=item(deployments, surface["deployment"]))
    rule = document["rule"]
    if rule["roles"]:
        zones = rule["zones"]
        scene.set_rule(Rule(np.array(rule["roles"], dtype=np.uint32),
                            np.array(rule["zone_shades"], dtype=np.uint8).reshape(zones, zones)))
    return scene


def _document(model: _programs.Name, weather: _programs.Name | None, flags: list[str], format_: str) -> dict[str, Any]:
    arguments: list[str | Path] = ["check", "--json", *flags, _programs.file(model, "model")]
    if weather is not None:
        arguments += ["-w", _programs.file(weather, "weather")]
    document = json.loads(_programs.gpu_shading(arguments))
    if document.get("format") != format_:
        raise RunError(f"the gpu_shading program writes {document.get('format')!r}, expected {format_!r}: it is of "
                       "another version than this package")
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
