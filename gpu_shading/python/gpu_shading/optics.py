"""Optics of shades: transmittance of the beam by angle of incidence, and perforated sheets."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from ctypes import byref
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gpu_shading import _library, _pickles
from gpu_shading._arrays import Floats, number, numbers, pointer, unmasked, whole, within
from gpu_shading.errors import InvalidInput

Hole = Literal["round", "square", "slotted", "hexagonal"]
Arrangement = Literal["straight", "staggered 45", "staggered 60"]
Plane = Literal["centre", "outside", "inside"]
Detail = Literal["automatic", "holes", "effective"]

_HOLES = ("round", "square", "slotted", "hexagonal")
_ARRANGEMENTS = ("straight", "staggered 45", "staggered 60")
_PLANES = ("centre", "outside", "inside")
_DETAILS = ("automatic", "holes", "effective")
_SOLID = 65535
_MOST_TEXELS_A_SIDE = 16384
_LARGE_HOLE = 0.5  # m; millimetres were probably meant


def choice(value: str, among: Sequence[str], what: str) -> int:
    if value not in among:
        raise InvalidInput(f"{what}: {value!r}, expected one of {', '.join(among)}")
    return among.index(value)


class FlatFilter:
    """A transmittance that depends on the direction alone, not on the place on a surface. `handle`: the library's."""

    handle: _library.Handle


class Transmittance(FlatFilter):
    """Beam solar transmittance of a flat shade by angle of incidence, 0 to 1, the same through both faces.

    Created by a class method, such as Transmittance.constant(0.4). A transmittance outside of 0 to 1 at any angle is an
    InvalidInput. Angles are in degrees from the normal, 0 to 90.
    """

    def __init__(self, recipe: tuple[str, dict[str, Any]], *arguments: Any) -> None:
        self._recipe = recipe
        self.handle = _library.Handle("filter", f"transmittance_{recipe[0]}", *arguments)

    def __reduce__(self) -> tuple[Any, ...]:
        return _reduced("Transmittance", self._recipe)

    @classmethod
    def constant(cls, value: float) -> Transmittance:
        """The same transmittance, 0 to 1, at every angle."""
        value = number(value, "transmittance")
        return cls(("constant", {"value": value}), value)

    @classmethod
    def polynomial(cls, coefficients: ArrayLike, *, of: Literal["cosine", "degrees"] = "cosine") -> Transmittance:
        """c[0] + c[1] x + ..., with up to nine coefficients, where x is the cosine of the angle of incidence, or the
        angle in degrees."""
        values = _row(coefficients, "coefficients")
        in_cosine = choice(of, ("cosine", "degrees"), "of") == 0
        return cls(("polynomial", {"coefficients": values.copy(), "of": of}), pointer(values), len(values),
                   int(in_cosine))

    @classmethod
    def table(cls, angles: ArrayLike, values: ArrayLike) -> Transmittance:
        """Monotone cubic interpolation of two or more points, and constant values beyond them. Angles increase."""
        x, y = _row(angles, "angles"), _row(values, "values")
        if len(x) != len(y):
            raise InvalidInput(f"values: {len(y)}, expected as many as angles, {len(x)}")
        return cls(("table", {"angles": x.copy(), "values": y.copy()}), pointer(x), pointer(y), len(x))

    @classmethod
    def glazing(cls, panes: ArrayLike) -> Transmittance:
        """Several panes, as EnergyPlus computes a construction of them.

        `panes`: a row for each, beginning with the one that faces the sun: transmittance, front and back reflectance at
        normal incidence, each 0 to 1."""
        rows = numbers(panes, "panes")
        if rows.ndim != 2 or rows.shape[1] != 3 or not len(rows):
            raise InvalidInput(f"panes: an array of shape {rows.shape}, expected (panes, 3)")
        return cls(("glazing", {"panes": rows.copy()}), pointer(rows), len(rows))

    @classmethod
    def simple_glazing(cls, u_factor: float, shgc: float) -> Transmittance:
        """EnergyPlus's simple window model: U-factor in W/(m2 K), above 0 and at most 7, and solar heat gain
        coefficient, 0 to 1."""
        u_factor, shgc = number(u_factor, "u_factor"), number(shgc, "shgc")
        return cls(("simple_glazing", {"u_factor": u_factor, "shgc": shgc}), u_factor, shgc)

    def tau(self, angles: ArrayLike) -> Floats:
        """Transmittance at each of `angles`, in an array of the same shape."""
        wanted = np.asarray(np.radians(within(numbers(angles, "angles"), "angles", 0.0, 90.0, " degrees")))
        results = np.empty(wanted.shape)
        _library.call("transmittance_at", self.handle, pointer(wanted), wanted.size, pointer(results))
        return results


class Screen:
    """A perforated sheet: a pattern of holes that repeats over a surface. Lengths are in metres.

    Created by Screen.pattern or Screen.image. `thickness` of the sheet may be 0. `plane`: where the surface's polygon
    lies in the sheet. `layers`: copies of the holes over the thickness, 1 to 64, or None for as many as needed.
    `detail`: draw "holes" one by one, use their "effective" transmittance, or choose by their size in pixels
    ("automatic").
    """

    def __init__(self, recipe: tuple[str, dict[str, Any]], make: str, *arguments: Any) -> None:
        self._recipe = recipe
        self.handle = _library.Handle("screen", make, *arguments)

    def __reduce__(self) -> tuple[Any, ...]:
        return _reduced("Screen", self._recipe)

    @classmethod
    def pattern(cls, hole: Hole, size: float, pitch: float, *, arrangement: Arrangement = "staggered 60",
                length: float = 0.0, row_pitch: float = 0.0, thickness: float = 0.0, plane: Plane = "centre",
                detail: Detail = "automatic") -> Screen:
        """Holes as on a manufacturer's data sheet.

        `size`: diameter, side of a square, width of a slot, or distance across a hexagon's flats. `pitch`: distance
        between the centres of nearest neighbours or, if `row_pitch` (the distance between rows) is given, of neighbours
        in a row. `length`: of a slot, from end to end. Holes that overlap are an InvalidInput.
        """
        lengths = {what: number(value, what) for value, what in (
            (size, "size"), (length, "length"), (pitch, "pitch"), (row_pitch, "row_pitch"))}
        if lengths["size"] >= _LARGE_HOLE:
            warnings.warn(f"Screen.pattern: holes of {lengths['size']:g} m at a pitch of {lengths['pitch']:g} m: "
                          "lengths are in metres", UserWarning, stacklevel=2)
        sheet = _sheet(thickness, plane, None, detail)
        recipe = {"hole": hole, "arrangement": arrangement, **lengths, "thickness": sheet.thickness, "plane": plane,
                  "detail": detail}
        return cls(("pattern", recipe), "screen_pattern", choice(hole, _HOLES, "hole"),
                   choice(arrangement, _ARRANGEMENTS, "arrangement"), pointer(np.array(list(lengths.values()))),
                   byref(sheet))

    @classmethod
    def image(cls, opacity: ArrayLike, width: float, height: float, *, threshold: float | None = 0.5,
              thickness: float = 0.0, plane: Plane = "centre", layers: int | None = None,
              detail: Detail = "automatic") -> Screen:
        """A tile of `width` x `height` with an opacity for each texel, 0 (open) to 1 (solid), in rows from the bottom.

        With a threshold, the tile is solid where the interpolated opacity is above it; with None, opacity is
        fractional. At most 16384 texels each way.
        """
        texels = numbers(opacity, "opacity")
        _require_texels(texels, "opacity")
        within(texels, "opacity", 0.0, 1.0)
        # Halves are rounded down, so that 0.5 is not above a threshold of 0.5.
        return cls.from_texels(np.ceil(texels * _SOLID - 0.5).astype(np.uint16), width, height, threshold=threshold,
                               thickness=thickness, plane=plane, layers=layers, detail=detail)

    @classmethod
    def from_texels(cls, texels: NDArray[np.uint16], width: float, height: float, *, threshold: float | None = 0.5,
                    thickness: float = 0.0, plane: Plane = "centre", layers: int | None = None,
                    detail: Detail = "automatic") -> Screen:
        """As image(), from opacities of 0 to 65535."""
        tile = np.array(unmasked(texels, "texels"), order="C")
        if tile.dtype != np.uint16:
            raise InvalidInput(f"texels: {tile.dtype}, expected uint16")
        _require_texels(tile, "texels")
        width, height = number(width, "width"), number(height, "height")
        limit = None if threshold is None else number(threshold, "threshold", 0.0, 1.0)
        sheet = _sheet(thickness, plane, layers, detail)
        recipe = {"texels": tile, "width": width, "height": height, "threshold": limit, "thickness": sheet.thickness,
                  "plane": plane, "layers": sheet.layers or None, "detail": detail}
        rows, columns = tile.shape
        return cls(("from_texels", recipe), "screen_tile", width, height, columns, rows, pointer(tile),
                   float("nan") if limit is None else limit, byref(sheet))

    def tau(self, theta: ArrayLike, phi: ArrayLike = 0.0) -> Floats:
        """Fraction of the beam that passes, away from the sheet's edges: exact for patterns, from a table for images.

        `theta`: angle of incidence from the normal, 0 to 90 degrees. `phi`: azimuth about the normal in degrees, from u
        (along a row of holes) towards v. The arrays are broadcast against each other.
        """
        try:
            angles = np.broadcast_arrays(
                np.radians(within(numbers(theta, "theta"), "theta", 0.0, 90.0, " degrees")),
                np.radians(numbers(phi, "phi")))
        except ValueError as error:
            if isinstance(error, InvalidInput):
                raise
            raise InvalidInput(f"theta and phi: shapes {np.shape(theta)} and {np.shape(phi)} do not fit") from None
        thetas, phis = (np.ascontiguousarray(angle) for angle in angles)
        results = np.empty(angles[0].shape)
        _library.call("screen_tau", self.handle, pointer(thetas), pointer(phis), results.size, pointer(results))
        return results

    def __repr__(self) -> str:
        kind = self._recipe[1].get("hole", "image")
        return f"<Screen: {kind}, {self.open_fraction:.1%} open, holes of {1000 * self.hole_size:.4g} mm>"

    @property
    def open_fraction(self) -> float:
        """Share of the sheet's area that is open, 0 to 1."""
        return float(self._sizes()[0])

    @property
    def hole_size(self) -> float:
        """The size of a typical hole, m."""
        return float(self._sizes()[1])

    @property
    def web(self) -> float:
        """The width of the narrowest web between holes, m.

        For an image, the longest step in its plane that steps over almost no web.
        """
        return float(self._sizes()[2])

    def _sizes(self) -> Floats:
        sizes = np.empty(3)
        _library.call("screen_sizes", self.handle, pointer(sizes))
        return sizes


def _row(values: ArrayLike, what: str) -> Floats:
    array = numbers(values, what)
    if array.ndim != 1:
        raise InvalidInput(f"{what}: an array of shape {array.shape}, expected one row")
    return array


def _require_texels(texels: NDArray[Any], what: str) -> None:
    if texels.ndim != 2 or not texels.size or max(texels.shape) > _MOST_TEXELS_A_SIDE:
        raise InvalidInput(f"{what}: an array of shape {texels.shape}, expected (rows, columns), 1 to "
                           f"{_MOST_TEXELS_A_SIDE} each way")


def _sheet(thickness: float, plane: str, layers: int | None, detail: str) -> _library.SheetRecord:
    return _library.SheetRecord(number(thickness, "thickness"), choice(plane, _PLANES, "plane"),
                                0 if layers is None else whole(layers, "layers", 1, 64),
                                choice(detail, _DETAILS, "detail"))


def _reduced(kind: str, recipe: tuple[str, dict[str, Any]]) -> tuple[Any, ...]:
    """For pickles: the function of a class that makes an object, and its arguments."""
    make, arguments = recipe
    return _restored, (_pickles.VERSION, kind, make, {
        name: _pickles.packed(value) if isinstance(value, np.ndarray) else value for name, value in arguments.items()})


def _restored(version: int, kind: str, make: str, arguments: Mapping[str, Any]) -> Any:
    _pickles.require_version(version)
    makers = {"Transmittance": ("constant", "polynomial", "table", "glazing", "simple_glazing"),
              "Screen": ("pattern", "from_texels")}
    choice(kind, tuple(makers), "pickle: kind")
    choice(make, makers[kind], f"pickle: {kind}")
    if not isinstance(arguments, Mapping):
        raise InvalidInput(f"pickle: {kind}: {type(arguments).__name__}, expected arguments by name")
    # Arrays are the only tuples.
    values = {name: _pickles.unpacked(value, name) if isinstance(value, tuple) else value
              for name, value in arguments.items()}
    return getattr({"Transmittance": Transmittance, "Screen": Screen}[kind], make)(**values)
