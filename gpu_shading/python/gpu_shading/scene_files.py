"""Scenes with values by time as files for 3D: glTF (.glb), VTK (.vtp) and ParaView's series of it (.pvd)."""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from gpu_shading._arrays import Floats
from gpu_shading._files import staged, write_whole
from gpu_shading.errors import InvalidInput

FORMATS = (".glb", ".vtp", ".pvd")
# A node of a .glb, an array of a .vtp or a file of a .pvd each.
MOST_TIMES = 1000


@dataclass(frozen=True)
class Part:
    """A surface of a scene, as it is drawn."""

    polygons: Sequence[Floats]
    """The outline, or triangles where it has holes."""
    triangles: Floats
    """Of shape (n, 3, 3)."""
    clear: bool
    """Lets some of the beam pass."""


@dataclass(frozen=True)
class Series:
    """Values of surfaces by time."""

    name: str
    times: tuple[str, ...]
    """Labels; empty for values that have no time."""
    values: Floats
    """Of shape (max(1, times), surfaces), nan where there is none."""

    @property
    def titles(self) -> list[str]:
        return [f"{self.name} {time}" for time in self.times] or [self.name]


def series(name: str, values: Any, times: Sequence[Any] | None, names: Sequence[str],
           receivers: Sequence[int]) -> Series:
    """Values as a scene's `sunlit` returns them, in columns of receivers, or by the name of each surface, in any case,
    as a run's `values` are."""
    if isinstance(values, Mapping):
        columns = {str(key).upper(): _floats(column, name) for key, column in values.items()}
        sizes = {column.shape for column in columns.values()}
        if len(sizes) != 1 or len(next(iter(sizes))) > 1:
            raise InvalidInput(f"values: {name}: arrays of shapes {sorted(sizes)}, expected one value of each surface "
                               "at each time")
        empty = np.full(next(iter(sizes)), np.nan)
        table = np.stack([columns.get(surface.upper(), empty) for surface in names], axis=-1)
        if np.isnan(table).all():
            raise InvalidInput(f"values: {name}: none of {', '.join(list(columns)[:3])} is a surface of the scene")
    else:
        given = _floats(values, name)
        if given.ndim not in (1, 2) or given.shape[-1] != len(receivers):
            raise InvalidInput(f"values: {name}: an array of shape {given.shape}, expected one value for each of "
                               f"{len(receivers)} receivers at each time")
        table = np.full((*given.shape[:-1], len(names)), np.nan)
        table[..., list(receivers)] = given
    steps = 0 if table.ndim == 1 else len(table)
    if table.ndim > 1 and not 1 <= steps <= MOST_TIMES:
        raise InvalidInput(f"values: {name}: {steps} times, expected 1 to {MOST_TIMES}")
    labels = tuple(map(str, times if times is not None else range(1, steps + 1)))
    if len(labels) != steps or len(set(labels)) != steps:
        raise InvalidInput(f"times: {len(set(labels))} different times, expected {steps}, one for each row of values")
    return Series(name, labels, table.reshape(-1, len(names)))


def _floats(values: Any, name: str) -> Floats:
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise InvalidInput(f"values: {name}: expected numbers") from None


def save(file: Path, parts: Sequence[Part], shown: Series | None) -> None:
    """Writes a file of the format that its suffix names."""
    suffix = file.suffix.lower()
    if suffix not in FORMATS:
        raise InvalidInput(f"file: {file}: expected a name that ends in one of {', '.join(FORMATS)}")
    if suffix == ".glb":
        write_whole(file, _glb(parts, shown))
    elif suffix == ".vtp":
        write_whole(file, _vtp(parts, dict(zip(shown.titles, shown.values, strict=True)) if shown else {}))
    else:
        _save_steps(file, parts, shown)


def _save_steps(file: Path, parts: Sequence[Part], shown: Series | None) -> None:
    """A .vtp for each time beside the .pvd, which lists them."""
    rows = shown.values if shown else [np.empty(0)]
    entries = []
    with staged(file) as temporary:
        for step, row in enumerate(rows):
            name = f"{file.stem}_{step:04d}.vtp"
            temporary.with_name(name).write_text(_vtp(parts, {shown.name: row} if shown else {}), encoding="utf-8")
            entries.append(f'<DataSet timestep="{step}" part="0" file={quoteattr(name)}/>\n')
        temporary.write_text('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'
                             + "".join(entries) + "</Collection>\n</VTKFile>\n", encoding="utf-8")


def _vtp(parts: Sequence[Part], columns: Mapping[str, Floats]) -> str:
    """Polygons, with arrays of cells: "surface", the index of each one's surface, and values."""
    rings = [ring for part in parts for ring in part.polygons]
    owners = np.repeat(np.arange(len(parts)), [len(part.polygons) for part in parts])
    points = np.concatenate([np.empty((0, 3)), *rings])
    offsets = np.cumsum([len(ring) for ring in rings])
    cells = [_data_array("surface", owners.astype("<i8"))]
    cells += [_data_array(name, values[owners].astype("<f4")) for name, values in columns.items()]
    scalars = f" Scalars={quoteattr(next(iter(columns)))}" if columns else ""
    return (f'<?xml version="1.0"?>\n'
            f'<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<PolyData>\n'
            f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" '
            f'NumberOfPolys="{len(rings)}">\n<CellData{scalars}>\n{"".join(cells)}</CellData>\n'
            f'<Points>\n{_data_array("Points", points.astype("<f8"), 3)}</Points>\n'
            f'<Polys>\n{_data_array("connectivity", np.arange(len(points)).astype("<i8"))}'
            f'{_data_array("offsets", offsets.astype("<i8"))}</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n')


def _data_array(name: str, values: NDArray[Any], components: int = 1) -> str:
    kind = {"i": "Int", "f": "Float"}[values.dtype.kind] + str(8 * values.dtype.itemsize)
    data = values.tobytes()
    text = base64.b64encode(struct.pack("<Q", len(data)) + data).decode()
    return (f'<DataArray type="{kind}" Name={quoteattr(name)} NumberOfComponents="{components}" format="binary">'
            f"{text}</DataArray>\n")


# Linear red, green, blue and alpha: of shade, of sun, of surfaces without values, and of those that let beam pass.
_SHADE = np.array([0.03, 0.06, 0.20, 1.0])
_SUN = np.array([1.00, 0.62, 0.08, 1.0])
_PLAIN = [0.45, 0.45, 0.45, 1.0]
_CLEAR = [0.45, 0.55, 0.60, 0.4]
_SECONDS = 0.5  # of each time in the animation


class _Buffer:
    """The binary part of a .glb, and what describes it."""

    _TYPES: Mapping[str, int] = {"<f4": 5126, "|u1": 5121}

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, values: NDArray[Any], kind: str, **more: Any) -> int:
        content = np.ascontiguousarray(values)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": content.nbytes})
        self.data += content.tobytes() + b"\0" * (-content.nbytes % 4)
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": self._TYPES[content.dtype.str],
                               "count": len(content), "type": kind, **more})
        return len(self.accessors) - 1


def _glb(parts: Sequence[Part], shown: Series | None) -> bytes:
    """One node of what has no values, and one for each time, of which an animation shows one after another. At first
    the time with the most is seen. The values themselves are attributes of vertices, _SURFACE and, as glTF asks for
    capitals, _VALUE."""
    buffer = _Buffer()
    has: NDArray[np.bool_] = np.zeros(len(parts), bool) if shown is None else np.any(~np.isnan(shown.values), axis=0)
    materials = [{"pbrMetallicRoughness": {"baseColorFactor": color, "metallicFactor": 0.0, "roughnessFactor": 1.0},
                  "doubleSided": True, **({"alphaMode": "BLEND"} if color[3] < 1.0 else {})}
                 for color in ([1.0, 1.0, 1.0, 1.0], _PLAIN, _CLEAR)]
    nodes: list[dict[str, Any]] = []
    meshes: list[dict[str, Any]] = []
    plain = []
    for material, clear in ((1, False), (2, True)):
        chosen = [index for index, part in enumerate(parts) if not has[index] and part.clear == clear]
        attributes, _ = _geometry(buffer, parts, chosen)
        if attributes:
            plain.append({"attributes": attributes, "material": material})
    if plain:
        nodes.append({"name": "surfaces", "mesh": len(meshes)})
        meshes.append({"name": "surfaces", "primitives": plain})
    document: dict[str, Any] = {"asset": {"version": "2.0", "generator": "gpu_shading"}, "scene": 0}
    if shown and has.any():
        attributes, owners = _geometry(buffer, parts, list(np.flatnonzero(has)))
        first = int(np.argmax(np.nan_to_num(shown.values).sum(axis=1)))
        timed = len(nodes)
        top = max(1.0, float(np.nanmax(shown.values)))
        for step, (title, values) in enumerate(zip(shown.titles, shown.values, strict=True)):
            of_vertices = values[owners]
            nodes.append({"name": title, "mesh": len(meshes)} | ({} if step == first else {"scale": [0.0, 0.0, 0.0]}))
            colored = {**attributes, "COLOR_0": buffer.add(_colors(of_vertices / top), "VEC4", normalized=True),
                       "_VALUE": buffer.add(np.nan_to_num(of_vertices, nan=-1.0).astype("<f4"), "SCALAR")}
            meshes.append({"name": title, "primitives": [{"attributes": colored, "material": 0}]})
        if shown.times:
            document["animations"] = [_animation(buffer, shown.name, timed, len(shown.times))]
    document |= {"scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
                 "materials": materials, "accessors": buffer.accessors, "bufferViews": buffer.views,
                 "buffers": [{"byteLength": len(buffer.data)}]}
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(buffer.data)
    return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(buffer.data), b"BIN\0") + bytes(buffer.data))


def _geometry(buffer: _Buffer, parts: Sequence[Part], chosen: Sequence[int]) -> tuple[dict[str, int],
                                                                                      NDArray[np.int64]]:
    """Attributes of the triangles of some surfaces, and the surface of each vertex. y is up in glTF."""
    triangles = np.concatenate([np.empty((0, 3, 3)), *(parts[index].triangles for index in chosen)])
    owners = np.repeat(np.array(chosen, dtype=np.int64), [3 * len(parts[index].triangles) for index in chosen])
    if not len(triangles):
        return {}, owners
    turned = triangles[..., [0, 2, 1]] * [1.0, 1.0, -1.0]
    normals = np.cross(turned[:, 1] - turned[:, 0], turned[:, 2] - turned[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(lengths > 0.0, normals / np.where(lengths > 0.0, lengths, 1.0), [0.0, 1.0, 0.0])
    positions = turned.reshape(-1, 3).astype("<f4")
    return {"POSITION": buffer.add(positions, "VEC3", min=positions.min(axis=0).tolist(),
                                   max=positions.max(axis=0).tolist()),
            "NORMAL": buffer.add(np.repeat(normals, 3, axis=0).astype("<f4"), "VEC3"),
            "_SURFACE": buffer.add(owners.astype("<f4"), "SCALAR")}, owners


def _colors(values: Floats) -> NDArray[np.uint8]:
    """From that of shade at 0 to that of sun at 1."""
    share = np.clip(np.nan_to_num(values), 0.0, 1.0)[:, None]
    colors: Floats = np.round(255.0 * ((1.0 - share) * _SHADE + share * _SUN))
    return colors.astype(np.uint8)


def _animation(buffer: _Buffer, name: str, first_node: int, steps: int) -> dict[str, Any]:
    """Scales each node to 1 while it is its time, and to 0 otherwise."""
    samplers, channels = [], []
    for step in range(steps):
        begin, end = _SECONDS * step, _SECONDS * (step + 1)
        keys = [(0.0, 0.0)] * (step > 0) + [(begin, 1.0), (end, 0.0 if step + 1 < steps else 1.0)]
        times = np.array([time for time, _ in keys], dtype="<f4")
        scales = np.array([[scale] * 3 for _, scale in keys], dtype="<f4")
        samplers.append({"input": buffer.add(times, "SCALAR", min=[float(times[0])], max=[float(times[-1])]),
                         "output": buffer.add(scales, "VEC3"), "interpolation": "STEP"})
        channels.append({"sampler": step, "target": {"node": first_node + step, "path": "scale"}})
    return {"name": name, "samplers": samplers, "channels": channels}
