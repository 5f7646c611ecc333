"""How much of a scene the sun reaches."""

from __future__ import annotations

import threading
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from ctypes import byref

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gpu_shading import _library
from gpu_shading._arrays import Floats, indices, numbers, pointer, suns, unit_vectors
from gpu_shading.errors import InvalidInput

Values = Mapping[str, float] | ArrayLike

_MIN_COSINE = 1e-5  # EnergyPlus's: with less, the sun is behind a surface
_MAX_DIRECTIONS = 1024  # in one call of the library, between which Python may stop
_FIRST_DIRECTIONS = 64
_LONG_CALL = 0.25  # s
_MAX_ANSWERS = 1 << 20


class Renderer:
    """Computes how much of a scene the sun reaches. Made by Scene.renderer. Threads may share one; it answers one
    question at a time, on all cores or on the GPU, and meanwhile other threads of Python run."""

    def __init__(self, handle: _library.Handle, vectors: Floats, receivers: Sequence[int],
                 factor_table: Callable[[Values | None, int | None], Floats],
                 shares: Callable[[Values | None], Floats]) -> None:
        self._handle = handle
        self._lock = threading.Lock()  # of the deployments and the question that they are for
        self._vectors = vectors  # normals, as long as areas
        self._receivers = receivers
        self._factor_table = factor_table
        self._shares = shares

    @property
    def device(self) -> str:
        """What computes, such as "CPU (2 threads, AVX2)"."""
        return _library.text("renderer_device", self._handle)

    def sunlit(self, directions: ArrayLike, *, receivers: Sequence[int] | None = None, factors: Values | None = None,
               deployments: Values | None = None) -> Floats:
        """Sunlit fractions, 0 to 1, of shape directions x receivers.

        `directions`: of shape (..., 2), azimuth clockwise from north and altitude from the horizon in degrees, or
        (..., 3), vectors to the sun. `receivers`: indices of surfaces, without which all that receive are meant.
        `factors`: values of the scene's schedules, by name or in their order, or a row of them for each direction;
        needed if the scene has schedules. `deployments`: the deployed part of screens, by name or in order, 1 if not
        given. Many directions in one call are faster than one call each.
        """
        angles, shape = suns(directions)
        wanted = self._wanted(receivers)
        areas = self._projected(angles, wanted, factors, deployments)
        vectors = self._vectors[wanted]
        facing = unit_vectors(angles) @ vectors.T
        lit = facing > _MIN_COSINE * np.linalg.norm(vectors, axis=1)
        fractions = np.divide(areas, facing, out=np.zeros_like(areas), where=lit)
        limited: Floats = np.clip(fractions, 0.0, 1.0)
        return limited.reshape(*shape, len(wanted))

    def projected_areas(self, directions: ArrayLike, *, receivers: Sequence[int] | None = None,
                        factors: Values | None = None, deployments: Values | None = None) -> Floats:
        """The same as areas normal to the beam, m2, as EnergyPlus asks for them."""
        angles, shape = suns(directions)
        wanted = self._wanted(receivers)
        return self._projected(angles, wanted, factors, deployments).reshape(*shape, len(wanted))

    def interior_areas(self, directions: ArrayLike, window: int, interiors: Sequence[int], *,
                       factors: Values | None = None, deployments: Values | None = None) -> Floats:
        """Areas normal to the beam (m2) of each of `interiors` that the sun lights through `window` alone."""
        angles, shape = suns(directions)
        through = int(indices([window], len(self._vectors), "window")[0])
        wanted = indices(interiors, len(self._vectors), "interiors")
        return self._ask("renderer_interior", angles, wanted, factors, deployments, through).reshape(
            *shape, len(wanted))

    def _wanted(self, receivers: Sequence[int] | None) -> NDArray[np.uint32]:
        return indices(self._receivers if receivers is None else receivers, len(self._vectors), "receivers")

    def _projected(self, angles: Floats, wanted: NDArray[np.uint32], factors: Values | None,
                   deployments: Values | None) -> Floats:
        return self._ask("renderer_sunlit", angles, wanted, factors, deployments)

    def _ask(self, question: str, angles: Floats, wanted: NDArray[np.uint32],
             factors: Values | None, deployments: Values | None, *window: int) -> Floats:
        table = self._factor_table(factors, len(angles))
        shares = self._shares(deployments)
        results = np.empty((len(angles), len(wanted)))
        max_step = max(1, min(_MAX_DIRECTIONS, _MAX_ANSWERS // max(1, len(wanted))))
        first, step = 0, min(max_step, _FIRST_DIRECTIONS)
        with self._lock:
            _library.call("renderer_set_deployments", self._handle, pointer(shares), len(shares))
            while first < len(angles) and len(wanted):
                began = time.monotonic()
                part, rows = angles[first:first + step], table if len(table) == 1 else table[first:first + step]
                _library.call(question, self._handle, pointer(part), len(part), *window, pointer(wanted), len(wanted),
                              byref(_library.FactorTable(pointer(rows), *rows.shape)), pointer(results[first:]))
                first += step
                step = min(max_step, 2 * step) if time.monotonic() - began < _LONG_CALL else max(1, step // 2)
            lines = _library.text("renderer_warnings", self._handle).splitlines()
        for line in lines:
            warnings.warn(line, RuntimeWarning, stacklevel=4)
        return results


def schedule_table(values: Values | None, names: list[str], directions: int | None, what: str,
           default: float | None) -> Floats:
    """Values of schedules, 0 to 1, in rows by the order of `names`."""
    if values is None:
        if names and default is None:
            raise InvalidInput(f"{what}: needed for the schedules {', '.join(names)}")
        return np.full((1, len(names)), 1.0 if default is None else default)
    if isinstance(values, Mapping):
        unknown = [name for name in values if name not in names]
        missing = [name for name in names if name not in values]
        if unknown or (missing and default is None):
            raise InvalidInput(f"{what}: expected {', '.join(names) or 'none'}, got {', '.join(map(str, values))}")
        table = numbers([values.get(name, default or 0.0) for name in names], what)
    else:
        table = numbers(values, what)
    rows = table[None] if table.ndim == 1 else table
    if rows.ndim != 2 or rows.shape[1] != len(names) or len(rows) not in (1, directions or 1):
        raise InvalidInput(f"{what}: an array of shape {table.shape}, expected ({len(names)},)" +
                           (f" or ({directions}, {len(names)})" if directions is not None else ""))
    if rows.size and (rows.min() < 0.0 or rows.max() > 1.0):
        raise InvalidInput(f"{what}: {rows.min():g} to {rows.max():g}, expected 0 to 1")
    return np.ascontiguousarray(rows)
