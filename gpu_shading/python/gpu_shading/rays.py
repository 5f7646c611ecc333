"""Single rays: the transmittance along them, and the surfaces that they meet."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from ctypes import byref
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gpu_shading import _library
from gpu_shading._arrays import Floats, indices, numbers, pointer, points, within
from gpu_shading.errors import InvalidInput

Faces = Literal["as casting", "both"]
RayScreens = Literal["automatic", "holes", "effective"]
_FACES = ("as casting", "both")
_SCREENS = ("automatic", "holes", "effective")


class Hits(NamedTuple):
    """The first surface that each ray meets."""

    surfaces: NDArray[np.int64]
    """Index of the surface, -1 where there is none."""
    distances: Floats
    """From the ray's origin, m; infinite where there is none."""


class Rays:
    """Answers for single rays through a scene. Created by Scene.rays. Any number of threads may ask at the same time.

    `origins` (m) and `directions` are arrays of shape (rays, 3); a direction may have any length except 0. `lengths`:
    where rays end, m; without, they are infinite. `receiver`: index of the surface that the rays are sent from or to:
    they do not meet it, and the scene's rule for it applies. `excluded`: indices of surfaces that the rays ignore.
    `factors` and `deployments`: as in Renderer.sunlit, one value for all rays.
    """

    def __init__(self, handle: _library.Handle, surfaces: int,
                 factor_table: Callable[[Mapping[str, float] | ArrayLike | None, int | None], Floats],
                 shares: Callable[[Mapping[str, float] | ArrayLike | None], Floats]) -> None:
        self._handle = handle
        self._surfaces = surfaces
        self._factor_table = factor_table
        self._shares = shares

    def transmittance(self, origins: ArrayLike, directions: ArrayLike, lengths: ArrayLike | None = None, *,
                      receiver: int | None = None, excluded: Sequence[int] = (),
                      factors: Mapping[str, float] | ArrayLike | None = None,
                      deployments: Mapping[str, float] | ArrayLike | None = None) -> Floats:
        """The transmittance along each ray, 0 to 1: the product of those of all surfaces on its way."""
        record, kept = self._record(origins, directions, lengths, receiver, excluded, factors, deployments)
        results = np.empty(record.rays)
        _library.call("rays_transmittance", self._handle, byref(record), pointer(results))
        del kept
        return results

    def nearest(self, origins: ArrayLike, directions: ArrayLike, lengths: ArrayLike | None = None, *,
                opaque: bool = False, receiver: int | None = None, excluded: Sequence[int] = (),
                factors: Mapping[str, float] | ArrayLike | None = None,
                deployments: Mapping[str, float] | ArrayLike | None = None) -> Hits:
        """The nearest surface that each ray meets, or with `opaque` the nearest that stops it."""
        record, kept = self._record(origins, directions, lengths, receiver, excluded, factors, deployments)
        hits = Hits(np.empty(record.rays, dtype=np.int64), np.empty(record.rays))
        _library.call("rays_nearest", self._handle, byref(record), int(opaque), pointer(hits.surfaces),
                      pointer(hits.distances))
        del kept
        return hits

    def _record(self, origins: ArrayLike, directions: ArrayLike, lengths: ArrayLike | None, receiver: int | None,
                excluded: Sequence[int], factors: Mapping[str, float] | ArrayLike | None,
                deployments: Mapping[str, float] | ArrayLike | None,
                ) -> tuple[_library.RayRecord, list[NDArray[np.generic]]]:
        """A record, and the arrays that it points to."""
        start, towards = points(origins, "origins"), numbers(directions, "directions")
        if towards.shape != start.shape:
            raise InvalidInput(f"directions: an array of shape {towards.shape}, expected {start.shape}, as origins")
        size = np.abs(towards).max(axis=1, initial=0.0)
        if (size == 0.0).any():
            raise InvalidInput(f"directions: vector {int(np.argmin(size))} is zero")
        towards = np.ascontiguousarray(towards / size[:, None])
        ends = np.full(len(start), np.inf) if lengths is None else numbers(lengths, "lengths", infinite=True)
        if ends.shape != (len(start),):
            raise InvalidInput(f"lengths: an array of shape {ends.shape}, expected ({len(start)},)")
        within(ends, "lengths", 0.0, np.inf, " m")
        asked = -1 if receiver is None else int(indices([receiver], self._surfaces, "receiver")[0])
        left_out = np.sort(indices(list(excluded), self._surfaces, "excluded"))
        values, shares = self._factor_table(factors, None)[0], self._shares(deployments)
        record = _library.RayRecord(pointer(start), pointer(towards), pointer(ends), len(start), asked,
                                    pointer(left_out), len(left_out), pointer(values), len(values), pointer(shares),
                                    len(shares))
        return record, [start, towards, ends, left_out, values, shares]


def make_rays(scene: _library.Handle, surfaces: int,
              factor_table: Callable[[Mapping[str, float] | ArrayLike | None, int | None], Floats],
              shares: Callable[[Mapping[str, float] | ArrayLike | None], Floats], faces: str, screens: str) -> Rays:
    if faces not in _FACES:
        raise InvalidInput(f"faces: {faces!r}, expected one of {', '.join(_FACES)}")
    if screens not in _SCREENS:
        raise InvalidInput(f"screens: {screens!r}, expected one of {', '.join(_SCREENS)}")
    handle = _library.Handle("rays", "rays_new", scene, _FACES.index(faces), _SCREENS.index(screens))
    return Rays(handle, surfaces, factor_table, shares)
