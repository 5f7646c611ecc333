"""A Honeybee model's GPUShading objects as IDF."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any

from honeybee_gpushading.objects import ExtensionObject, MovingShade

# As honeybee-energy's writer, which leaves out what is smaller.
_DEGENERATE = 0.01


def model_to_gpu_shading(model: Any) -> str:
    """The objects for what honeybee-energy writes of a model: a side file, or a part of the IDF."""
    model = in_metres(model)
    names = _written_names(model)
    # honeybee-energy writes what is orphaned as shading surfaces too.
    orphans = (*model.orphaned_faces, *model.orphaned_apertures, *model.orphaned_doors)
    every = [*(name for written in names.values() for name in written), *(orphan.identifier for orphan in orphans)]
    used: set[str] = set()
    texts = [tree.to_idf(_unique(tree.name, used)) for tree in model.properties.gpu_shading.trees]
    users: dict[ExtensionObject, list[str]] = {}
    for shade in _shades_outdoors(model):
        for thing in shade.properties.gpu_shading.objects:
            users.setdefault(thing, []).extend(names[shade.identifier])
    for thing, surfaces in users.items():
        pattern = _pattern(surfaces, set(every) - set(surfaces))
        if pattern is None and isinstance(thing, MovingShade):
            raise ValueError(f"MovingShade {thing.name!r}: moves {', '.join(surfaces[:3])}, ..., for which no pattern "
                             "with one * stands that no other shade matches: expected identifiers that begin alike")
        for surface in surfaces if pattern is None else [pattern]:
            texts.append(thing.to_idf(_unique(thing.name, used), surface))
    return "\n".join(texts)


def in_metres(model: Any) -> Any:
    """A copy with the shades that are written."""
    model = model.duplicate()
    if model.units != "Meters":
        model.convert_to_units("Meters")
    model.remove_degenerate_geometry(_DEGENERATE)
    return model


def schedules_to_idf(model: Any) -> str:
    """Schedules that honeybee-energy does not write, because only GPUShading objects name them."""
    energy = model.properties.energy
    written = [*energy.schedules, *energy.orphaned_trans_schedules]
    identifiers = {schedule.identifier for schedule in written} | {"Always On"}
    limits = {schedule.schedule_type_limit for schedule in written}
    days = {day.identifier: day for schedule in written for day in getattr(schedule, "day_schedules", ())}
    texts = []
    for schedule in model.properties.gpu_shading.schedules:
        if schedule.identifier in identifiers:
            continue
        limit = schedule.schedule_type_limit
        if limit is not None and limit not in limits:
            limits.add(limit)
            texts.append(limit.to_idf())
        if not hasattr(schedule, "day_schedules"):
            texts.append(schedule.to_idf_compact())
        else:
            year, weeks = schedule.to_idf()
            texts += [year, *(weeks or [])]
            for day in schedule.day_schedules if weeks is not None else ():
                if days.setdefault(day.identifier, day) != day:
                    raise ValueError(f"{schedule.identifier}: {day.identifier}: another schedule of a day has this "
                                     "identifier")
                texts.append(day.to_idf(limit))
    return "\n\n".join(texts)


def _shades_outdoors(model: Any) -> Iterable[Any]:
    """Those that honeybee-energy writes."""
    for room in model.rooms:
        for face in room.faces:
            for part in (*face.apertures, *face.doors, face):
                yield from part.outdoor_shades
        yield from room.outdoor_shades
    yield from model.orphaned_shades
    yield from model.shade_meshes


def _written_names(model: Any) -> dict[str, list[str]]:
    """The names of surfaces in IDF; each face of a mesh is one."""
    return {shade.identifier: [f"{shade.identifier}_{index}" for index in range(len(shade.geometry.faces))]
            if type(shade).__name__ == "ShadeMesh" else [shade.identifier] for shade in _shades_outdoors(model)}


def _pattern(names: Sequence[str], others: Iterable[str]) -> str | None:
    """A name, or text with one *, for these names and none of the others. Case is ignored."""
    if len(names) == 1:
        return names[0]
    folded = [name.upper() for name in names]
    start = os.path.commonprefix(folded)
    end = os.path.commonprefix([name[len(start):][::-1] for name in folded])[::-1]
    if any(len(other) >= len(start) + len(end) and other.startswith(start) and other.endswith(end)
           for other in (name.upper() for name in others)):
        return None
    return f"{names[0][:len(start)]}*{end}"


def _unique(name: str, used: set[str]) -> str:
    number, found = 1, name
    while found.upper() in used:
        number += 1
        found = f"{name} {number}"
    used.add(found.upper())
    return found
