"""Sunlit fractions and areas of the surfaces of a scene."""

from __future__ import annotations

import contextlib
import importlib
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from ctypes import byref
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gpu_shading import _library
from gpu_shading._arrays import Floats, indices, numbers, pointer, suns, unit_vectors
from gpu_shading.errors import InvalidInput

if TYPE_CHECKING:
    import xarray

Values = Mapping[str, float] | ArrayLike
Receivers = Sequence[int] | Sequence[str] | Sequence[int | str]

_MIN_COSINE = 1e-5  # EnergyPlus's: with less, the sun is behind a surface
_ON_HORIZON = 1e-9  # radians, for the rounding of vectors
_ROUNDING = 1e-7  # the error of exact answers
_MAX_DIRECTIONS = 1024  # in one call of the library, between which Python may stop
_FIRST_DIRECTIONS = 64
_LONG_CALL = 0.25  # s
_MAX_ANSWERS = 1 << 20


class Renderer:
    """Computes sunlit fractions of a scene. Created by Scene.renderer. Threads may share one; it answers one question
    at a time, on all cores or on the GPU, while other threads of Python run."""

    def __init__(self, handle: _library.Handle, vectors: Floats, receivers: Sequence[int], names: Sequence[str],
                 factor_table: Callable[[Values | None, int | None], Floats],
                 shares: Callable[[Values | None], Floats]) -> None:
        self._handle = handle
        self._lock = threading.Lock()  # of the deployments and the question that they are for
        self._vectors = vectors  # normals, as long as areas
        self._receivers = receivers
        self._names = names
        self._factor_table = factor_table
        self._shares = shares

    @property
    def device(self) -> str:
        """The device that renders, such as "CPU (2 threads, AVX2)"."""
        return _library.text("renderer_device", self._handle)

    def __repr__(self) -> str:
        return f"<Renderer: {len(self._receivers)} receivers, {self.device}>"

    @overload
    def sunlit(self, directions: ArrayLike, *, receivers: Receivers | None = None, factors: Values | None = None,
               deployments: Values | None = None, below_horizon: bool = False, labelled: Literal[False] = False,
               progress: bool = False) -> Floats: ...

    @overload
    def sunlit(self, directions: ArrayLike, *, receivers: Receivers | None = None, factors: Values | None = None,
               deployments: Values | None = None, below_horizon: bool = False, labelled: Literal[True],
               progress: bool = False) -> xarray.DataArray: ...

    def sunlit(self, directions: ArrayLike, *, receivers: Receivers | None = None, factors: Values | None = None,
               deployments: Values | None = None, below_horizon: bool = False, labelled: bool = False,
               progress: bool = False) -> Floats | xarray.DataArray:
        """Sunlit fractions, 0 to 1, of shape directions x receivers: 0 where the sun is below the horizon or behind the
        receiver. A receiver whose vertices run clockwise faces the other way (Scene.facing).

        `directions`: of shape (..., 2), azimuth clockwise from north and altitude from the horizon in degrees, or
        (..., 3), vectors to the sun. `receivers`: indices or names of surfaces; all that receive if None.
        `factors`: values of the scene's schedules, 0 to 1, by name or in their order, or a row of them for each
        direction; required if the scene has schedules. `deployments`: the deployed part of screens, 0 to 1, by name or
        in order; 1 if not given. `below_horizon`: light comes from there, too, since nothing but the scene hides it.
        `labelled`: return an xarray DataArray with the names of receivers, the azimuths and altitudes of directions,
        and the errors that 99 % of such fractions are within, 1e-7 where they are exact and NaN where they are not
        measured. `progress`: show a bar (needs tqdm).

        Many directions in one call are faster than one call each. Arrays of a wrong shape or with values out of range
        raise InvalidInput, and a device that fails DeviceError.
        """
        angles, shape = suns(directions)
        wanted = self._wanted(receivers)
        areas, errors = self._ask("renderer_sunlit", angles, wanted, factors, deployments, below_horizon,
                                  progress=progress)
        vectors = self._vectors[wanted]
        facing = unit_vectors(angles) @ vectors.T
        lit = facing > _MIN_COSINE * np.linalg.norm(vectors, axis=1)
        fractions = np.divide(areas, facing, out=np.zeros_like(areas), where=lit)
        limited: Floats = np.clip(fractions, 0.0, 1.0).reshape(*shape, len(wanted))
        return self._labelled(limited, errors.reshape(limited.shape), angles, shape, wanted) if labelled else limited

    def projected_areas(self, directions: ArrayLike, *, receivers: Receivers | None = None,
                        factors: Values | None = None, deployments: Values | None = None,
                        below_horizon: bool = False) -> Floats:
        """Sunlit areas normal to the beam, m2, of shape directions x receivers; arguments as in sunlit."""
        angles, shape = suns(directions)
        wanted = self._wanted(receivers)
        areas, _ = self._ask("renderer_sunlit", angles, wanted, factors, deployments, below_horizon)
        return areas.reshape(*shape, len(wanted))

    def interior_areas(self, directions: ArrayLike, window: int, interiors: Sequence[int], *,
                       factors: Values | None = None, deployments: Values | None = None,
                       below_horizon: bool = False) -> Floats:
        """Areas normal to the beam, m2, of each of `interiors` that the sun lights through `window` alone; of shape
        directions x interiors. Arguments as in sunlit."""
        angles, shape = suns(directions)
        through = int(indices([window], len(self._vectors), "window")[0])
        wanted = indices(interiors, len(self._vectors), "interiors")
        areas, _ = self._ask("renderer_interior", angles, wanted, factors, deployments, below_horizon, through)
        return areas.reshape(*shape, len(wanted))

    def _wanted(self, receivers: Receivers | None) -> NDArray[np.uint32]:
        if receivers is None:
            return indices(self._receivers, len(self._vectors), "receivers")
        if isinstance(receivers, str):
            raise InvalidInput(f"receivers: {receivers!r}, expected a list")
        if not isinstance(receivers, np.ndarray):
            receivers = [self._index(one) if isinstance(one, str) else one for one in receivers]
        return indices(receivers, len(self._vectors), "receivers")

    def _index(self, name: str) -> int:
        for among in (self._receivers, range(len(self._names))):
            for index in among:
                if self._names[index].upper() == name.upper():
                    return index
        raise InvalidInput(f"receivers: {name}: no surface of that name")

    def _labelled(self, fractions: Floats, errors: Floats, angles: Floats, shape: tuple[int, ...],
                  wanted: NDArray[np.uint32]) -> xarray.DataArray:
        try:
            xarray_ = importlib.import_module("xarray")
        except ImportError:
            raise ImportError("labelled answers need xarray: pip install xarray") from None
        dims = [f"direction_{axis}" if len(shape) > 1 else "direction" for axis in range(len(shape))]
        azimuth, altitude = (values.reshape(shape) for values in np.degrees(angles).T)
        made: xarray.DataArray = xarray_.DataArray(
            fractions, dims=[*dims, "receiver"], name="sunlit_fraction",
            coords={"azimuth": (dims, np.remainder(azimuth, 360.0), {"units": "degree"}),
                    "altitude": (dims, altitude, {"units": "degree"}),
                    "error": ([*dims, "receiver"], errors),
                    "receiver": [self._names[index] for index in wanted]})
        return made

    def _ask(self, question: str, angles: Floats, wanted: NDArray[np.uint32],
             factors: Values | None, deployments: Values | None, below_horizon: bool, *window: int,
             progress: bool = False) -> tuple[Floats, Floats]:
        """Areas and errors."""
        table = self._factor_table(factors, len(angles))
        shares = self._shares(deployments)
        asked = np.flatnonzero((angles[:, 1] > -_ON_HORIZON) | below_horizon)
        results = np.zeros((2, len(angles), len(wanted)))
        results[1] = _ROUNDING
        results[:, asked] = self._render(question, angles[asked], wanted, table if len(table) == 1 else table[asked],
                                         shares, *window, progress=progress)
        return results[0], results[1]

    def _render(self, question: str, angles: Floats, wanted: NDArray[np.uint32], table: Floats, shares: Floats,
                *window: int, progress: bool) -> Floats:
        results = np.empty((2, len(angles), len(wanted)))
        max_step = max(1, min(_MAX_DIRECTIONS, _MAX_ANSWERS // max(1, len(wanted))))
        first, step = 0, min(max_step, _FIRST_DIRECTIONS)
        with self._lock, _bar(len(angles) if progress else None) as advance:
            _library.call("renderer_set_deployments", self._handle, pointer(shares), len(shares))
            while first < len(angles) and len(wanted):
                began = time.monotonic()
                part, rows = angles[first:first + step], table if len(table) == 1 else table[first:first + step]
                _library.call(question, self._handle, pointer(part), len(part), *window, pointer(wanted), len(wanted),
                              byref(_library.FactorTable(pointer(rows), *rows.shape)),
                              *(pointer(values[first:]) for values in results))
                first += step
                advance(len(part))
                step = min(max_step, 2 * step) if time.monotonic() - began < _LONG_CALL else max(1, step // 2)
            lines = _library.text("renderer_warnings", self._handle).splitlines()
        for line in lines:
            warnings.warn(line, RuntimeWarning, stacklevel=5)
        return results


@contextlib.contextmanager
def _bar(total: int | None) -> Iterator[Callable[[int], Any]]:
    """A function to call with the number of directions that were answered."""
    if total is None:
        yield lambda _: None
        return
    try:
        tqdm = importlib.import_module("tqdm.auto").tqdm
    except ImportError:
        raise ImportError("progress needs tqdm: pip install tqdm") from None
    with tqdm(total=total, unit="sun") as bar:
        yield bar.update


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
