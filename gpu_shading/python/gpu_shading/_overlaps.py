"""Surfaces that lie on one another in a plane, as windows do on their wall: each place is left to one of them, or
viewers show a flicker of both."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from gpu_shading._arrays import Floats

_DISTANCE = 1e-3  # m, of vertices from the plane
_SLIVER = 1e-7  # m2, of an overlap that does not count
_NORMALS, _OFFSETS = 0.05, 0.05  # sizes of the cells in which planes are looked up; m for offsets


def without_overlaps(triangles: Sequence[Floats], valued: NDArray[np.bool_]) -> list[list[Floats] | None]:
    """What is left of each surface, as convex polygons, or None if all of it is. A place belongs to the smallest
    surface there; of equal ones, to one with values, then to the first. `triangles`: of each surface, (n, 3, 3)."""
    vectors = _area_vectors(triangles)
    areas = np.linalg.norm(vectors, axis=1)
    rank = np.empty(len(areas), int)
    keys = [(float(f"{area:.5g}"), not value, index) for index, (area, value) in
            enumerate(zip(areas, valued, strict=True))]
    rank[[key[2] for key in sorted(keys)]] = np.arange(len(areas))
    cutters: dict[int, list[int]] = {}
    for one, other in _in_one_plane(triangles, vectors, areas):
        low, high = (one, other) if rank[one] > rank[other] else (other, one)
        cutters.setdefault(low, []).append(high)
    left: list[list[Floats] | None] = [None] * len(areas)
    for index, others in cutters.items():
        left[index] = _cut(triangles[index], vectors[index] / areas[index], [triangles[other] for other in others])
    return left


def fans(polygons: Sequence[Floats]) -> Floats:
    """Triangles of convex polygons, of shape (n, 3, 3)."""
    corners = [polygon[[0, i, i + 1]] for polygon in polygons for i in range(1, len(polygon) - 1)]
    return np.array(corners).reshape(-1, 3, 3)


def _area_vectors(triangles: Sequence[Floats]) -> Floats:
    corners = np.concatenate([np.empty((0, 3, 3)), *triangles])
    crosses = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    owners = np.repeat(np.arange(len(triangles)), [len(each) for each in triangles])
    return np.column_stack([np.bincount(owners, column, len(triangles)) for column in crosses.T])


def _in_one_plane(triangles: Sequence[Floats], vectors: Floats, areas: Floats) -> Iterator[tuple[int, int]]:
    """Pairs whose boxes meet and whose vertices are near the plane of the larger one."""
    drawn = np.flatnonzero(areas > _SLIVER)
    if not len(drawn):
        return
    low, high = np.zeros((2, len(areas), 3))
    for index in map(int, drawn):
        corners = triangles[index].reshape(-1, 3)
        low[index], high[index] = corners.min(axis=0) - _DISTANCE, corners.max(axis=0) + _DISTANCE
    middle = 0.5 * (low[drawn].min(axis=0) + high[drawn].max(axis=0))
    normals = vectors / np.where(areas > 0.0, areas, 1.0)[:, None]
    # Either face: the largest component counts as positive.
    signs = np.sign(normals[np.arange(len(areas)), np.abs(normals).argmax(axis=1)])
    planes = normals * signs[:, None]
    offsets = np.einsum("ij,ij->i", planes, 0.5 * (low + high) - middle)
    found: set[tuple[int, int]] = set()
    for members in _shared_cells(np.column_stack([planes / _NORMALS, offsets / _OFFSETS]), drawn):
        order = members[np.argsort(low[members, 0])]
        ends = np.searchsorted(low[order, 0], high[order, 0], side="right")
        for place in np.flatnonzero(ends > np.arange(1, len(order) + 1)):
            one, after = order[place], order[place + 1:ends[place]]
            for other in after[((low[after] < high[one]) & (low[one] < high[after])).all(axis=1)]:
                pair = (min(int(one), int(other)), max(int(one), int(other)))
                if pair not in found:
                    found.add(pair)
                    if _is_flat(triangles, normals, areas, *pair):
                        yield pair


def _shared_cells(places: Floats, chosen: NDArray[np.int64]) -> Iterator[NDArray[np.int64]]:
    """Those that share a cell of size 1. Each is in the two nearest cells along every axis, so that near ones do."""
    for shift in itertools.product((-0.5, 0.5), repeat=places.shape[1]):
        cells = np.floor(places[chosen] + shift).astype(np.int64)
        _, groups, counts = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
        order = np.argsort(groups.ravel(), kind="stable")
        ends = np.cumsum(counts)
        for end, count in zip(ends[counts > 1], counts[counts > 1], strict=True):
            yield chosen[order[end - count:end]]


def _is_flat(triangles: Sequence[Floats], normals: Floats, areas: Floats, one: int, other: int) -> bool:
    large = one if areas[one] >= areas[other] else other
    corners = np.concatenate([triangles[one], triangles[other]]).reshape(-1, 3)
    return bool(np.abs((corners - triangles[large][0, 0]) @ normals[large]).max() < _DISTANCE)


def _cut(triangles: Floats, normal: Floats, others: Sequence[Floats]) -> list[Floats] | None:
    across = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    across /= np.linalg.norm(across)
    axes = np.stack([across, np.cross(normal, across)])
    start = triangles[0, 0]

    def flat(corners: Floats) -> Floats:
        return np.asarray((corners - start) @ axes.T)

    pieces = [flat(corners) for corners in triangles]
    boxes, dropped, is_cut = _boxes(pieces), np.zeros(len(pieces), bool), False
    for triangle in itertools.chain.from_iterable(others):
        cutter = flat(triangle)
        cutter = cutter if _area(cutter) > 0.0 else cutter[::-1]
        near = ((boxes[:, 0] < cutter.max(axis=0)) & (boxes[:, 1] > cutter.min(axis=0))).all(axis=1) & ~dropped
        new: list[Floats] = []
        for index in np.flatnonzero(near):
            part = _minus(pieces[index], cutter)
            if part is not None:
                dropped[index] = is_cut = True
                new += part
        pieces += new
        boxes = np.concatenate([boxes, _boxes(new)])
        dropped = np.append(dropped, np.zeros(len(new), bool))
    if not is_cut:
        return None
    return [start + piece @ axes for piece, gone in zip(pieces, dropped, strict=True) if not gone]


def _boxes(polygons: Sequence[Floats]) -> Floats:
    """Lowest and highest coordinates of each, of shape (n, 2, 2)."""
    return np.array([[polygon.min(axis=0), polygon.max(axis=0)] for polygon in polygons]).reshape(-1, 2, 2)


def _minus(piece: Floats, cutter: Floats) -> list[Floats] | None:
    """A convex polygon without a triangle, as convex polygons; None if they do not overlap."""
    outside, inside = [], piece if _area(piece) > 0.0 else piece[::-1]
    for begin, end in zip(cutter, np.roll(cutter, -1, axis=0), strict=True):
        edge = end - begin
        heights = edge[0] * (inside[:, 1] - begin[1]) - edge[1] * (inside[:, 0] - begin[0])
        outside.append(_half(inside, -heights))
        inside = _half(inside, heights)
        if _area(inside) < _SLIVER:
            return None
    return [each for each in outside if _area(each) >= _SLIVER]


def _half(polygon: Floats, heights: Floats) -> Floats:
    """The part of a convex polygon where heights, of its vertices, are not negative."""
    kept = []
    for (point, height), (after, next_height) in itertools.pairwise([*zip(polygon, heights, strict=True),
                                                                     (polygon[0], heights[0])] if len(polygon) else []):
        if height >= 0.0:
            kept.append(point)
        if (height > 0.0) != (next_height > 0.0) and height * next_height < 0.0:
            kept.append(point + (after - point) * (height / (height - next_height)))
    return np.array(kept).reshape(-1, 2)


def _area(polygon: Floats) -> float:
    if len(polygon) < 3:
        return 0.0
    x, y = (polygon - polygon[0]).T
    return float(0.5 * (x[:-1] * y[1:] - x[1:] * y[:-1]).sum())
