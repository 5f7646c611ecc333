"""GPUShading objects as Honeybee has them. Fields, values and units are those of EnergyPlus's input, in the same order;
blank is None, and a schedule is an object of honeybee-energy or the name of a schedule of the model."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar, Literal, TypeVar

_Object = TypeVar("_Object", bound="ExtensionObject")


@dataclass(frozen=True)
class ExtensionObject:
    """What all of them have."""

    name: str
    keyword: ClassVar[str]

    @property
    def schedules(self) -> list[Any]:
        """The schedules that are objects."""
        found = [getattr(self, field.name) for field in fields(self) if field.name.endswith("_schedule")]
        return [schedule for schedule in found if schedule is not None and not isinstance(schedule, str)]

    def to_dict(self, abridged: bool = False) -> dict[str, Any]:
        """For HBJSON; abridged, with the identifiers of schedules."""
        written: dict[str, Any] = {"type": type(self).__name__}
        for field in fields(self):
            value = getattr(self, field.name)
            if value is None or value == ():
                continue
            if field.name.endswith("_schedule") and not isinstance(value, str):
                value = value.identifier if abridged else value.to_dict()
            written[field.name] = list(value) if isinstance(value, tuple) else value
        return written

    @classmethod
    def from_dict(cls: type[_Object], data: Mapping[str, Any], schedules: Mapping[str, Any] | None = None) -> _Object:
        """Of what to_dict returns; `schedules` by identifier."""
        if data.get("type") != cls.__name__:
            raise ValueError(f"type: {data.get('type')!r}, expected {cls.__name__!r}")
        known = {field.name for field in fields(cls)}
        values = {key: value for key, value in data.items() if key != "type"}
        if unknown := sorted(set(values) - known):
            raise ValueError(f"{cls.__name__} {values.get('name')!r}: {unknown[0]}: no such field")
        for key, value in values.items():
            if key.endswith("_schedule"):
                values[key] = schedule_of(value) if isinstance(value, Mapping) else (schedules or {}).get(value, value)
            elif isinstance(value, list):
                values[key] = tuple(value)
        return cls(**values)

    def to_idf(self, name: str, surface: str | None = None) -> str:
        """As an object of that name, for the shading surfaces of a name or pattern."""
        values = [name, *([] if surface is None else [surface]), *self._values()]
        while values[-1] == "":
            values.pop()
        for value in values:
            if any(character in value for character in ",;!\r\n"):
                raise ValueError(f"{type(self).__name__} {self.name!r}: {value!r}: expected no comma, semicolon, "
                                 "exclamation mark or line break")
        return f"{self.keyword},\n  " + ",\n  ".join(values) + ";\n"

    def _values(self) -> Iterator[str]:
        for field in fields(self)[1:]:
            value = getattr(self, field.name)
            if field.name.endswith("_schedule") and value is not None and not isinstance(value, str):
                value = value.identifier
            for item in value if isinstance(value, tuple) else (value,):
                yield "" if item is None else repr(float(item)) if isinstance(item, float) else str(item)


@dataclass(frozen=True)
class PerforatedScreen(ExtensionObject):
    """A perforated sheet. Its sizes are in metres, whatever the units of the model."""

    keyword = "GPUShading:PerforatedScreen"
    hole_shape: Literal["Texture", "Round", "Square", "Slotted", "Hexagonal"]
    texture_file_name: str | None = None
    arrangement: Literal["Straight", "Staggered45", "Staggered60"] | None = None
    hole_size: float | None = None
    hole_length: float | None = None
    pitch: float | None = None
    row_pitch: float | None = None
    thickness: float = 0.0
    sheet_plane: Literal["Centre", "Outside", "Inside"] | None = None
    layers: int | Literal["Auto"] | None = None
    opacity: Literal["Threshold", "Fractional"] | None = None
    opacity_threshold: float | None = None
    invert_opacity: Literal["Yes", "No"] | None = None
    tile_width: float | None = None
    tile_height: float | None = None
    tile_origin_u: float | None = None
    tile_origin_v: float | None = None
    tile_rotation: float | None = None
    deployment_schedule: Any = None
    detail: Literal["Auto", "Holes", "Effective"] | None = None


@dataclass(frozen=True)
class TransparentShade(ExtensionObject):
    """Glass, film or fabric: what passes of the beam, by its angle of incidence."""

    keyword = "GPUShading:TransparentShade"
    transmittance_model: Literal["Constant", "PolynomialInDegrees", "PolynomialInCosine", "Table", "TableFile",
                                 "Construction"]
    value: tuple[float | str, ...]


@dataclass(frozen=True)
class MovingShade(ExtensionObject):
    """How shades move. Those whose motions have the same name and values move together. The point and the positions of
    Slide are in the units of the model, and turn and grow with it as the direction does. The axes of CentreLine and
    Edge point east, north or up, also after the model has turned."""

    keyword = "GPUShading:MovingShade"
    motion: Literal["Rotate", "Slide", "Extend", "Fold"]
    axis: Literal["CentreLine", "Edge", "Given"] | None = None
    direction_x: float | None = None
    direction_y: float | None = None
    direction_z: float | None = None
    point_x: float | None = None
    point_y: float | None = None
    point_z: float | None = None
    minimum_position: float | None = None
    maximum_position: float | None = None
    step: float | None = None
    position_at_rest: float | None = None
    control: Literal["Schedule", "BlockBeam", "TrackSun"] | None = None
    position_schedule: Any = None
    receiver_name: str | None = None
    availability_schedule: Any = None
    minimum_beam: float | None = None
    hysteresis: float | None = None
    maximum_wind_speed: float | None = None
    tolerance: float | None = None

    def moved(self, move: Any, turn: Any, mirrored: bool = False) -> MovingShade:
        """With functions that change a Point3D and a Vector3D."""
        motion = self
        if motion.axis == "Given":
            motion = _with(motion, "point", move)
        if any((motion.direction_x, motion.direction_y, motion.direction_z)):
            motion = _with(motion, "direction", turn)
            if mirrored and motion.axis == "Given":  # an axis of rotation keeps its sense
                motion = _with(motion, "direction", lambda vector: vector * -1)
        return motion

    def scaled(self, factor: float) -> MovingShade:
        if self.motion != "Slide":
            return self
        lengths = ("minimum_position", "maximum_position", "step", "position_at_rest", "hysteresis")
        return replace(self, **{name: getattr(self, name) * factor for name in lengths
                                if getattr(self, name) is not None})


@dataclass(frozen=True)
class Tree(ExtensionObject):
    """A tree, in the coordinates and units of the model (densities per metre), or the trees of a map file."""

    keyword = "GPUShading:Tree"
    x: float | None = None
    y: float | None = None
    z: float | None = None
    height: float | None = None
    crown_diameter: float | None = None
    crown_base_height: float | None = None
    crown_shape: Literal["Ellipsoid", "HalfEllipsoid", "Cone", "Cylinder", "Mesh"] | None = None
    trunk_diameter: float | None = None
    leaf_cycle: Literal["Deciduous", "Evergreen"] | None = None
    leaf_schedule: Any = None
    leaf_area_density: float | None = None
    wood_area_density: float | None = None
    leaf_angles: Literal["Spherical", "Planophile", "Erectophile"] | None = None
    file_name: str | None = None
    coordinates: str | None = None
    crown_mesh_name: str | None = None
    genus: str | None = None

    def moved(self, move: Any) -> Tree:
        """With a function that changes a Point3D; trees of a file stay where the map has them."""
        return self if self.file_name else _with(self, "", move)

    def scaled(self, factor: float) -> Tree:
        if self.file_name:
            return self
        lengths = ("height", "crown_diameter", "crown_base_height", "trunk_diameter")
        return replace(self, **{name: getattr(self, name) * factor for name in lengths
                                if getattr(self, name) is not None})


def _with(thing: Any, name: str, change: Any) -> Any:
    """With a point or vector in three fields that has been changed."""
    geometry = importlib.import_module("ladybug_geometry.geometry3d.pointvector")
    names = [f"{name}_{axis}" if name else axis for axis in "xyz"]
    kind = geometry.Vector3D if name == "direction" else geometry.Point3D
    changed = change(kind(*(getattr(thing, field) or 0.0 for field in names)))
    return replace(thing, **dict(zip(names, (changed.x, changed.y, changed.z), strict=True)))


def schedule_of(data: Mapping[str, Any]) -> Any:
    """The schedule of a dictionary that is not abridged."""
    modules = {"ScheduleRuleset": "ruleset", "ScheduleFixedInterval": "fixedinterval"}
    kind = str(data.get("type"))
    if kind not in modules:
        raise ValueError(f"schedule: type: {kind!r}, expected one of {', '.join(modules)}")
    return getattr(importlib.import_module(f"honeybee_energy.schedule.{modules[kind]}"), kind).from_dict(data)
