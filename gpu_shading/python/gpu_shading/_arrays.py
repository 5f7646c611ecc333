"""Arrays from the user: converted, and refused with one line if their shape or a number is wrong."""

from __future__ import annotations

import operator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gpu_shading.errors import InvalidInput

Floats = NDArray[np.float64]
FARTHEST = 1e7  # m; beyond it, single precision has no metre left
MAX_VERTICES = 100_000  # of one surface


def _masked_position(values: object) -> list[int] | None:
    """The index of the first value that a mask hides. numpy.asarray would uncover it."""
    if isinstance(values, np.ma.MaskedArray):
        for position in np.argwhere(np.ma.getmaskarray(values)):
            return [int(index) for index in position]
    elif isinstance(values, (list, tuple)):
        for index, value in enumerate(values):
            inner = _masked_position(value)
            if inner is not None:
                return [index, *inner]
    return None


def unmasked(values: ArrayLike, what: str) -> NDArray[Any]:
    position = _masked_position(values)
    if position is not None:
        raise InvalidInput(f"{what}: masked at {position}, expected numbers")
    return np.asarray(values)


def pointer(array: NDArray[Any]) -> int:
    return int(array.ctypes.data)


def numbers(values: ArrayLike, what: str, *, infinite: bool = False) -> Floats:
    """A dense array of finite numbers, or also of infinite ones."""
    try:
        found = unmasked(values, what)
        # Text, and objects such as None, would be converted too.
        if found.dtype.kind not in "biuf":
            raise ValueError
        array = np.ascontiguousarray(found, dtype=np.float64).reshape(found.shape)
    except InvalidInput:
        raise
    except (TypeError, ValueError):
        raise InvalidInput(f"{what}: expected an array of numbers") from None
    bad = np.isnan(array) if infinite else ~np.isfinite(array)
    if bad.any():
        position = tuple(int(index) for index in np.argwhere(bad)[0])
        raise InvalidInput(f"{what}: {array[position]} at {list(position)}, expected finite numbers")
    return array


def number(value: float, what: str, low: float = -np.inf, high: float = np.inf) -> float:
    array = numbers(value, what)
    if array.ndim != 0:
        raise InvalidInput(f"{what}: expected one number, got an array of shape {array.shape}")
    return float(within(array, what, low, high))


def whole(value: int, what: str, low: int, high: int) -> int:
    try:
        found = operator.index(value)
    except TypeError:
        raise InvalidInput(f"{what}: {value!r}, expected a whole number") from None
    if not low <= found <= high:
        raise InvalidInput(f"{what}: {found}, expected {low} to {high}")
    return found


def within(array: Floats, what: str, low: float, high: float, unit: str = "") -> Floats:
    """The array, if all its numbers are in a range."""
    wrong = (array < low) | (array > high)
    if wrong.any():
        position = tuple(int(index) for index in np.argwhere(wrong)[0])
        at = f" at {list(position)}" if position else ""
        raise InvalidInput(f"{what}: {array[position]:g}{at}, expected {low:g} to {high:g}{unit}")
    return array


def points(values: ArrayLike, what: str) -> Floats:
    """x, y, z (m) in rows."""
    array = numbers(values, what)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InvalidInput(f"{what}: an array of shape {array.shape}, expected (number, 3)")
    if array.size and np.abs(array).max() > FARTHEST:
        raise InvalidInput(f"{what}: {np.abs(array).max():g} m, expected {FARTHEST:g} m at most from the origin")
    return array


def ring(values: ArrayLike, what: str) -> Floats:
    """The vertices of a polygon."""
    array = points(values, what)
    if not 3 <= len(array) <= MAX_VERTICES:
        raise InvalidInput(f"{what}: {len(array)} vertices, expected 3 to {MAX_VERTICES}")
    return array


def suns(values: ArrayLike) -> tuple[Floats, tuple[int, ...]]:
    """(azimuth and altitude in radians in rows, shape of what was given without its last axis)."""
    array = numbers(values, "directions")
    if array.ndim == 0 or array.shape[-1] not in (2, 3):
        raise InvalidInput(f"directions: an array of shape {array.shape}, expected (..., 2), azimuth and altitude in "
                           "degrees, or (..., 3), vectors to the sun")
    shape, rows = array.shape[:-1], array.reshape(-1, array.shape[-1])
    if rows.shape[1] == 3:
        with np.errstate(over="ignore"):
            longest = np.abs(rows).max(axis=1, keepdims=True, initial=0.0)
        if (longest == 0.0).any():
            raise InvalidInput(f"directions: vector {int(np.argmin(longest))} is zero")
        x, y, z = (rows / longest).T
        return np.column_stack([np.arctan2(x, y), np.arctan2(z, np.hypot(x, y))]), shape
    if rows.size and np.abs(rows[:, 1]).max() > 90.0:
        raise InvalidInput(f"directions: altitude {rows[np.abs(rows[:, 1]).argmax(), 1]:g}, expected -90 to 90 degrees")
    return np.radians(np.column_stack([np.remainder(rows[:, 0], 360.0), rows[:, 1]])), shape


def unit_vectors(angles: Floats) -> Floats:
    """Towards the sun: x east, y north, z up."""
    azimuth, altitude = angles.T
    return np.column_stack([np.cos(altitude) * np.sin(azimuth), np.cos(altitude) * np.cos(azimuth), np.sin(altitude)])


def indices(values: ArrayLike, count: int, what: str) -> NDArray[np.uint32]:
    """Indices of surfaces, 0 .. count - 1."""
    try:
        found = unmasked(values, what)
    except InvalidInput:
        raise
    except ValueError:
        raise InvalidInput(f"{what}: lists of different lengths, expected a list of indices of surfaces") from None
    if found.ndim != 1 or (found.size and found.dtype.kind not in "iu"):
        raise InvalidInput(f"{what}: {found.dtype} of shape {found.shape}, expected a list of indices of surfaces")
    if found.size and (found.min() < 0 or found.max() >= count):
        raise InvalidInput(f"{what}: {found.min()} to {found.max()}, expected 0 to {count - 1}")
    return np.ascontiguousarray(found, dtype=np.uint32)
