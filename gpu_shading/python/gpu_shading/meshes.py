"""Meshes of other packages: trimesh and PyVista."""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gpu_shading._arrays import Floats, numbers, points
from gpu_shading.errors import InvalidInput


def faces_of(mesh: Any) -> list[Floats]:
    """The corners of each face of a mesh."""
    vertices = getattr(mesh, "vertices", None)
    if vertices is None:
        vertices = getattr(mesh, "points", None)
    faces = getattr(mesh, "faces", None)
    if vertices is None or faces is None:
        raise InvalidInput(f"mesh: {type(mesh).__name__}, expected a trimesh.Trimesh or a pyvista.PolyData")
    places = points(vertices, "mesh: vertices")
    table = np.asarray(faces)
    # VTK's list has the number of corners before those of each face.
    lists = _unpacked(table) if table.ndim == 1 else list(table)
    if any(len(face) < 3 or face.min() < 0 or face.max() >= len(places) for face in lists):
        raise InvalidInput(f"mesh: faces: expected three or more indices of {len(places)} vertices each")
    corners = [places[face] for face in lists]
    # Triangles without an area receive and cast nothing.
    return [face for face in corners if np.linalg.norm(_area_vector(face)) > 0.0]


def to_pyvista(polygons: Sequence[Sequence[Floats]], values: Mapping[str, ArrayLike]) -> Any:
    """Surfaces, each of one or more polygons, as a PolyData. Cells have the values of their surface, and its index as
    "surface"."""
    pyvista = _needed("pyvista")
    rings = [ring for parts in polygons for ring in parts]
    owners = np.repeat(np.arange(len(polygons)), [len(parts) for parts in polygons])
    cells: list[int] = []
    first = 0
    for ring in rings:
        cells += [len(ring), *range(first, first + len(ring))]
        first += len(ring)
    places = np.concatenate(rings) if rings else np.empty((0, 3))
    made = pyvista.PolyData(places, faces=np.array(cells, dtype=np.int64))
    made.cell_data["surface"] = owners
    for name, column in values.items():
        array = numbers(column, f"values: {name}")
        if array.shape[:1] != (len(polygons),):
            raise InvalidInput(f"values: {name}: an array of shape {array.shape}, expected one value for each of "
                               f"{len(polygons)} surfaces")
        made.cell_data[name] = array[owners]
    return made


def to_trimesh(triangles: Sequence[Floats]) -> Any:
    """Surfaces, each of an array of triangles x 3 x 3, as one mesh with the indices of surfaces."""
    trimesh = _needed("trimesh")
    places = np.concatenate([np.empty((0, 3)), *(corners.reshape(-1, 3) for corners in triangles)])
    owners = np.repeat(np.arange(len(triangles)), [len(corners) for corners in triangles])
    return trimesh.Trimesh(places, np.arange(len(places)).reshape(-1, 3), process=False,
                           face_attributes={"surface": owners})


def _unpacked(table: np.ndarray[Any, Any]) -> list[np.ndarray[Any, Any]]:
    lists = []
    at = 0
    while at < len(table):
        count = int(table[at])
        lists.append(table[at + 1:at + 1 + count])
        if count < 3 or len(lists[-1]) < count:
            raise InvalidInput("mesh: faces: expected the number of corners before those of each face")
        at += 1 + count
    return lists


def _area_vector(ring: Floats) -> Floats:
    vector: Floats = np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0) - 0.0
    return vector


def _needed(module: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError:
        raise ImportError(f"this mesh needs {module}: pip install {module}") from None
