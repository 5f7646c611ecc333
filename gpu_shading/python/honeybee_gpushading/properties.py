"""Properties of Honeybee's models and shades: `properties.gpu_shading`."""

from __future__ import annotations

import importlib
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from honeybee_gpushading.objects import (
    ExtensionObject,
    MovingShade,
    PerforatedScreen,
    TransparentShade,
    Tree,
    schedule_of,
)

KEY = "gpu_shading"


class ShadeGPUShadingProperties:
    """Of a Shade or a ShadeMesh: its screen or its transmittance, and its motion."""

    _KINDS: Mapping[str, type[ExtensionObject]] = {
        "screen": PerforatedScreen, "transmittance": TransparentShade, "motion": MovingShade}

    def __init__(self, host: Any) -> None:
        self._host = host
        self._objects: dict[str, ExtensionObject] = {}

    @property
    def host(self) -> Any:
        return self._host

    @property
    def screen(self) -> PerforatedScreen | None:
        return self._objects.get("screen")  # type: ignore[return-value]

    @screen.setter
    def screen(self, value: PerforatedScreen | None) -> None:
        self._set("screen", value)

    @property
    def transmittance(self) -> TransparentShade | None:
        return self._objects.get("transmittance")  # type: ignore[return-value]

    @transmittance.setter
    def transmittance(self, value: TransparentShade | None) -> None:
        self._set("transmittance", value)

    @property
    def motion(self) -> MovingShade | None:
        return self._objects.get("motion")  # type: ignore[return-value]

    @motion.setter
    def motion(self, value: MovingShade | None) -> None:
        self._set("motion", value)

    @property
    def objects(self) -> tuple[ExtensionObject, ...]:
        """All that it has."""
        return tuple(self._objects.values())

    def _set(self, name: str, value: ExtensionObject | None) -> None:
        if value is None:
            self._objects.pop(name, None)
            return
        if not isinstance(value, self._KINDS[name]):
            raise ValueError(f"{self._host.identifier}: {name}: {type(value).__name__}, expected a "
                             f"{self._KINDS[name].__name__}")
        self._objects[name] = value
        if self.screen and self.transmittance:
            del self._objects[name]
            raise ValueError(f"{self._host.identifier}: expected a screen or a transmittance, not both")

    def move(self, moving_vec: Any) -> None:
        self._change(lambda point: point.move(moving_vec), lambda vector: vector)

    def rotate(self, axis: Any, angle: float, origin: Any) -> None:
        turn = math.radians(angle)
        self._change(lambda point: point.rotate(axis, turn, origin), lambda vector: vector.rotate(axis, turn))

    def rotate_xy(self, angle: float, origin: Any) -> None:
        turn = math.radians(angle)
        self._change(lambda point: point.rotate_xy(turn, origin), lambda vector: vector.rotate_xy(turn))

    def reflect(self, plane: Any) -> None:
        self._change(lambda point: point.reflect(plane.n, plane.o), lambda vector: vector.reflect(plane.n), True)

    def scale(self, factor: float, origin: Any = None) -> None:
        if self.motion:
            self.motion = self.motion.scaled(factor)
        self._change(lambda point: point.scale(factor, origin), lambda vector: vector)

    def _change(self, move: Any, turn: Any, mirrored: bool = False) -> None:
        if self.motion:
            self.motion = self.motion.moved(move, turn, mirrored)

    def reset_to_default(self) -> None:
        self._objects.clear()

    def is_equivalent(self, other: ShadeGPUShadingProperties) -> bool:
        return self._objects == other._objects

    def duplicate(self, new_host: Any = None) -> ShadeGPUShadingProperties:
        copied = ShadeGPUShadingProperties(new_host or self._host)
        copied._objects = dict(self._objects)
        return copied

    def to_dict(self, abridged: bool = False) -> dict[str, Any]:
        """Nothing where nothing was set, so that other models stay as they are."""
        if not self._objects:
            return {}
        return {KEY: {"type": _type_of(self._host) + ("Abridged" if abridged else ""),
                      **{name: value.to_dict(abridged) for name, value in self._objects.items()}}}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any], host: Any) -> ShadeGPUShadingProperties:
        made = cls(host)
        made.apply_properties_from_dict(data, {})
        return made

    def apply_properties_from_dict(self, data: Mapping[str, Any], schedules: Mapping[str, Any]) -> None:
        if data.get("type") not in (_type_of(self._host), _type_of(self._host) + "Abridged"):
            raise ValueError(f"{self._host.identifier}: type: {data.get('type')!r}, expected {_type_of(self._host)!r}")
        for name, kind in self._KINDS.items():
            if data.get(name) is not None:
                self._set(name, kind.from_dict(data[name], schedules))

    def __repr__(self) -> str:
        return f"GPUShading Properties: {self._host.identifier}"

    ToString = __repr__


class ModelGPUShadingProperties:
    """Of a Model: its trees."""

    def __init__(self, host: Any) -> None:
        self._host = host
        self._trees: tuple[Tree, ...] = ()

    @property
    def host(self) -> Any:
        return self._host

    @property
    def trees(self) -> tuple[Tree, ...]:
        return self._trees

    @trees.setter
    def trees(self, value: Iterable[Tree]) -> None:
        trees = tuple(value)
        if wrong := [tree for tree in trees if not isinstance(tree, Tree)]:
            raise ValueError(f"trees: {type(wrong[0]).__name__}, expected a Tree")
        self._trees = trees

    @property
    def schedules(self) -> list[Any]:
        """The schedules of its trees and shades, each once."""
        found: dict[str, Any] = {}
        for thing in [*self._trees, *(thing for shade in shades_of(self._host)
                                      for thing in shade.properties.gpu_shading.objects)]:
            for schedule in thing.schedules:
                if found.setdefault(schedule.identifier, schedule) != schedule:
                    raise ValueError(f"{thing.name}: {schedule.identifier}: another schedule has this identifier")
        return list(found.values())

    def move(self, moving_vec: Any) -> None:
        self._change(lambda point: point.move(moving_vec))

    def rotate(self, axis: Any, angle: float, origin: Any) -> None:
        """Trees stay upright."""
        self._change(lambda point: point.rotate(axis, math.radians(angle), origin))

    def rotate_xy(self, angle: float, origin: Any) -> None:
        self._change(lambda point: point.rotate_xy(math.radians(angle), origin))

    def reflect(self, plane: Any) -> None:
        self._change(lambda point: point.reflect(plane.n, plane.o))

    def scale(self, factor: float, origin: Any = None) -> None:
        self._trees = tuple(tree.scaled(factor) for tree in self._trees)
        self._change(lambda point: point.scale(factor, origin))

    def _change(self, move: Any) -> None:
        self._trees = tuple(tree.moved(move) for tree in self._trees)

    def is_equivalent(self, other: ModelGPUShadingProperties) -> bool:
        return self._trees == other._trees

    def duplicate(self, new_host: Any = None) -> ModelGPUShadingProperties:
        copied = ModelGPUShadingProperties(new_host or self._host)
        copied._trees = self._trees
        return copied

    def to_dict(self) -> dict[str, Any]:
        if not self._trees and not any(shade.properties.gpu_shading.objects for shade in shades_of(self._host)):
            return {}
        return {KEY: {"type": _type_of(self._host), "trees": [tree.to_dict(abridged=True) for tree in self._trees],
                      "schedules": [schedule.to_dict() for schedule in self.schedules]}}

    def apply_properties_from_dict(self, data: Mapping[str, Any]) -> None:
        """From the dictionary of a whole model."""
        utility = importlib.import_module("honeybee.extensionutil")
        own = data["properties"][KEY]
        schedules = {each["identifier"]: schedule_of(each) for each in own.get("schedules") or []}
        self.trees = [Tree.from_dict(tree, schedules) for tree in own.get("trees") or []]
        of_shades = utility.model_extension_dicts(data, KEY, [], [], [], [], [])[2]
        for shade, found in zip(shades_of(self._host), of_shades, strict=True):
            if found:
                shade.properties.gpu_shading.apply_properties_from_dict(found, schedules)

    def __repr__(self) -> str:
        return f"GPUShading Properties: {self._host.identifier}"

    ToString = __repr__


def shades_of(model: Any) -> Sequence[Any]:
    """All shades, in the order of model_extension_dicts."""
    return [*model.shades, *model.shade_meshes]


def _type_of(host: Any) -> str:
    return f"{type(host).__name__}GPUShadingProperties"
