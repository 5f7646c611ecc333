"""The functions of libgpu_shading_python.so (gpu_shading/python/*_calls.cpp). Python's other threads run meanwhile."""

from __future__ import annotations

import atexit
import ctypes
import os
import threading
import weakref
from collections.abc import Callable
from ctypes import POINTER, Structure, byref, c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p
from typing import Any

from gpu_shading import _programs
from gpu_shading._arrays import whole
from gpu_shading.errors import DeviceError, Error, InvalidInput

_INVALID, _DEVICE, _MEMORY, _CLOSED = 1, 2, 3, 5


class SurfaceRecord(Structure):
    _fields_ = [("name", c_char_p), ("vertices", c_void_p), ("ring_sizes", c_void_p), ("rings", c_size_t),
                ("casting", c_int), ("filter", c_void_p), ("schedule", c_int), ("screen", c_void_p),
                ("origin_u", c_double), ("origin_v", c_double), ("rotation", c_double), ("deployment", c_int)]


class SheetRecord(Structure):
    _fields_ = [("thickness", c_double), ("plane", c_int), ("layers", c_int), ("detail", c_int)]


class FactorTable(Structure):
    _fields_ = [("values", c_void_p), ("rows", c_size_t), ("columns", c_size_t)]


class RayRecord(Structure):
    _fields_ = [("origins", c_void_p), ("directions", c_void_p), ("lengths", c_void_p), ("rays", c_size_t),
                ("receiver", ctypes.c_int64), ("excluded", c_void_p), ("excluded_count", c_size_t),
                ("factors", c_void_p), ("factor_count", c_size_t),
                ("deployments", c_void_p), ("deployment_count", c_size_t)]


_MADE = POINTER(c_void_p)
_CALLS: dict[str, list[Any]] = {
    "limit_threads": [c_int],
    "transmittance_constant": [c_double, _MADE],
    "transmittance_polynomial": [c_void_p, c_size_t, c_int, _MADE],
    "transmittance_table": [c_void_p, c_void_p, c_size_t, _MADE],
    "transmittance_glazing": [c_void_p, c_size_t, _MADE],
    "transmittance_simple_glazing": [c_double, c_double, _MADE],
    "transmittance_at": [c_void_p, c_void_p, c_size_t, c_void_p],
    "filter_crown": [c_int, c_double, c_double, c_int, c_double, c_void_p, c_size_t, _MADE],
    "screen_pattern": [c_int, c_int, c_void_p, POINTER(SheetRecord), _MADE],
    "screen_tile": [c_double, c_double, c_int, c_int, c_void_p, c_double, POINTER(SheetRecord), _MADE],
    "screen_sizes": [c_void_p, c_void_p],
    "screen_tau": [c_void_p, c_void_p, c_void_p, c_size_t, c_void_p],
    "scene_new": [_MADE],
    "scene_add": [c_void_p, POINTER(SurfaceRecord)],
    "scene_set_rule": [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t],
    "scene_areas": [c_void_p, c_void_p],
    "scene_triangles": [c_void_p, c_size_t, c_void_p, POINTER(c_size_t)],
    "renderer_new": [c_void_p, c_char_p, c_int, c_double, _MADE],
    "renderer_device": [c_void_p],
    "renderer_warnings": [c_void_p],
    "renderer_set_deployments": [c_void_p, c_void_p, c_size_t],
    "renderer_sunlit": [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, POINTER(FactorTable), c_void_p, c_void_p],
    "renderer_interior": [c_void_p, c_void_p, c_size_t, c_uint32, c_void_p, c_size_t, POINTER(FactorTable), c_void_p,
                          c_void_p],
    "rays_new": [c_void_p, c_int, c_int, _MADE],
    "rays_transmittance": [c_void_p, POINTER(RayRecord), c_void_p],
    "rays_nearest": [c_void_p, POINTER(RayRecord), c_int, c_void_p, c_void_p],
}
_TEXTS = ("message", "version")
_RELEASES = ("filter", "screen", "scene", "renderer", "rays")


def _load() -> ctypes.CDLL:
    loaded = ctypes.CDLL(str(_programs.library()))
    for name, arguments in _CALLS.items():
        function = getattr(loaded, f"gpu_shading_{name}")
        function.argtypes, function.restype = arguments, c_int
    for name in _TEXTS:
        function = getattr(loaded, f"gpu_shading_{name}")
        function.argtypes, function.restype = [], c_char_p
    for name in _RELEASES:
        function = getattr(loaded, f"gpu_shading_{name}_release")
        function.argtypes, function.restype = [c_void_p], None
    loaded.gpu_shading_close.argtypes, loaded.gpu_shading_close.restype = [], None
    return loaded


_LOADED = _load()


_PROCESS = os.getpid()


def _close() -> None:
    """Lets daemon threads that compute finish, before what they use is destroyed."""
    # A forked process has none of its parent's threads.
    if os.getpid() == _PROCESS:
        _LOADED.gpu_shading_close()


# Before weakref's own function, which releases all objects: it is registered with the first finalizer, and the last
# that is registered runs first.
weakref.finalize(_close, lambda: None).atexit = False
atexit.register(_close)


def _text(name: str) -> str:
    found: bytes = getattr(_LOADED, f"gpu_shading_{name}")()
    return found.decode(errors="replace")


def call(name: str, *arguments: Any) -> None:
    """Calls a function, and raises what it fails with."""
    status = getattr(_LOADED, f"gpu_shading_{name}")(*arguments)
    if status == 0:
        return
    if status == _MEMORY:
        raise MemoryError
    if status == _CLOSED and threading.current_thread() is not threading.main_thread():
        raise SystemExit  # ends a daemon thread, and is not reported
    kind: type[Error] = {_INVALID: InvalidInput, _DEVICE: DeviceError}.get(status, Error)
    raise kind("Python is exiting" if status == _CLOSED else _text("message"))


def text(name: str, *arguments: Any) -> str:
    """What a function leaves as text."""
    call(name, *arguments)
    return _text("message")


class Handle:
    """An object of the library, released with this one."""

    def __init__(self, kind: str, make: str, *arguments: Any) -> None:
        pointer = c_void_p()
        call(make, *arguments, byref(pointer))
        self._as_parameter_ = pointer
        release: Callable[[c_void_p], None] = getattr(_LOADED, f"gpu_shading_{kind}_release")
        self._finalizer = weakref.finalize(self, release, pointer)

    @property
    def pointer(self) -> c_void_p:
        return self._as_parameter_


def limit_threads(count: int) -> None:
    """Sets the maximum number of threads that compute in this process at a time, with the calling one."""
    call("limit_threads", min(whole(count, "count", 1, 1 << 31), 1 << 20))


__version__ = _text("version")
