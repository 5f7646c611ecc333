"""Contents of pickles: a version, and plain numbers, text and bytes, which are checked like arguments. Unpickling files
of strangers remains unsafe: pickle itself executes what they say."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gpu_shading.errors import InvalidInput

VERSION = 1
_TYPES = ("<f8", "<u2", "<u4", "|u1")

Packed = tuple[str, tuple[int, ...], bytes]


def packed(array: NDArray[Any]) -> Packed:
    kind = array.dtype.newbyteorder("<")
    return kind.str, array.shape, array.astype(kind).tobytes()


def unpacked(value: Any, what: str) -> NDArray[Any]:
    """A new array. It takes no more memory than the bytes that are there."""
    try:
        kind, shape, data = value
        sizes = [int(size) for size in shape]
        known = kind in _TYPES and isinstance(data, bytes) and len(sizes) <= 2 and min(sizes, default=0) >= 0
    except (TypeError, ValueError, OverflowError):
        known = False
    if not known:
        raise InvalidInput(f"pickle: {what}: no array, expected a type, a shape and bytes")
    expected = math.prod(sizes) * np.dtype(kind).itemsize
    if len(data) != expected:
        raise InvalidInput(f"pickle: {what}: {len(data)} bytes, expected {expected} for an array of shape "
                           f"{tuple(sizes)}")
    little = np.frombuffer(data, dtype=kind).reshape(sizes)
    return little.astype(little.dtype.newbyteorder("="))


def require_version(version: Any) -> None:
    if version != VERSION:
        raise InvalidInput(f"pickle: version {version!r}, expected {VERSION}: it is of another version of gpu_shading")
