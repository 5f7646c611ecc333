"""Pictures of EnergyPlus models by the gpu_shading program: views, maps, shading masks and screens. A notebook shows
each result."""

from __future__ import annotations

import base64
import importlib
import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from gpu_shading import _html, _programs
from gpu_shading._arrays import Floats
from gpu_shading._files import write_whole
from gpu_shading._reading import rows_of
from gpu_shading.errors import InvalidInput

Projection = Literal["stereographic", "equidistant", "cylindrical"]
Kinds = ("building", "shades", "geometry", "trees", "neighbours", "terrain")


@dataclass(frozen=True, repr=False)
class Picture:
    """A PNG image, empty if the installation has no picture formats."""

    png: bytes

    def save(self, file: _programs.Name) -> None:
        """Writes or replaces the .png, as a whole or not at all."""
        if Path(file).suffix.lower() != ".png":
            raise InvalidInput(f"file: {os.fspath(file)!r}: expected a name that ends in .png")
        write_whole(file, self.png)

    @property
    def pixels(self) -> NDArray[np.uint8]:
        """Red, green and blue, of shape (rows, columns, 3). Needs Pillow."""
        try:
            image = importlib.import_module("PIL.Image")
        except ImportError:
            raise ImportError("pixels need Pillow: pip install pillow") from None
        io = importlib.import_module("io")
        return np.asarray(image.open(io.BytesIO(self.png)).convert("RGB"))

    def _repr_png_(self) -> bytes:
        return self.png

    def __repr__(self) -> str:
        return f"<Picture: {len(self.png)} bytes of PNG>"


@dataclass(frozen=True, repr=False)
class Map:
    """Sunlit hours and beam energy over a receiver."""

    name: str
    hours: Floats
    """h, in rows from below, nan where the receiver has no cell."""
    energy: Floats
    """Beam solar energy, kWh/m2, in the same cells."""
    mean_hours: float
    mean_energy: float
    picture: Picture
    centres: Floats
    """World axes, in the same rows and columns, and nan where there is no cell."""
    normal: Floats
    cell_size: tuple[float, float]
    """Width and height, m."""

    def _repr_png_(self) -> bytes:
        return self.picture.png

    def __repr__(self) -> str:
        return f"<Map of {self.name}: {self.mean_hours:.1f} h, {self.mean_energy:.1f} kWh/m2>"


@dataclass(frozen=True)
class MaskHour:
    """The sun at a full hour of standard time on the 21st of a month."""

    month: int
    hour: int
    azimuth: float
    altitude: float
    sunlit: float | None
    """Sunlit fraction; None where the sun is behind the receiver."""
    stopped: dict[str, float]
    """Share of the beam that each kind of shade stops."""
    beam: float
    """Direct normal irradiance, W/m2."""
    marked: bool


@dataclass(frozen=True, repr=False)
class Mask:
    """The sky as seen from a receiver, or from a point of it."""

    name: str
    view_factor: float
    unshaded_view_factor: float
    stopped: dict[str, float]
    """The part of the view factor that each kind of shade takes."""
    azimuths: Floats
    """Degrees, of the columns of `sky`."""
    altitudes: Floats
    """Degrees, of its rows."""
    sky: Floats
    """Sunlit fraction from each direction, nan behind the receiver."""
    horizon: Floats
    """Degrees, at each azimuth: below it, more than half is hidden."""
    hours: tuple[MaskHour, ...]
    picture: Picture
    svg: str

    def _repr_png_(self) -> bytes:
        return self.picture.png

    def __repr__(self) -> str:
        return f"<Mask of {self.name}: sky view factor {self.view_factor:.3f} of {self.unshaded_view_factor:.3f}>"


@dataclass(frozen=True, repr=False)
class Sheet:
    """A perforated screen of a model."""

    name: str
    description: str
    theta: Floats
    """Angles of incidence, degrees: the rows of `tau`."""
    phi: Floats
    """Azimuths about the normal, degrees: its columns."""
    tau: Floats
    """Fraction of the beam that passes."""
    picture: Picture
    svg: str

    def _repr_png_(self) -> bytes:
        return self.picture.png

    def __repr__(self) -> str:
        return f"<Sheet {self.name}: {self.tau[0, 0]:.1%} open>"


_Item = TypeVar("_Item", Map, Mask, Sheet)


class Drawings(Sequence[_Item], Generic[_Item]):
    """Results of one command, by position or by name in any case."""

    def __init__(self, items: Sequence[_Item]) -> None:
        self._items: tuple[_Item, ...] = tuple(items)

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return self._items[key]
        for item in self._items:
            if item.name.upper() == key.upper():
                return item
        raise KeyError(f"{key}: expected one of {', '.join(self.names)}")

    def __len__(self) -> int:
        return len(self._items)

    @property
    def names(self) -> list[str]:
        return [item.name for item in self._items]

    def _repr_html_(self) -> str:
        most = 6
        pictures = (f'<img alt="{number}" style="max-width: 48%" src="data:image/png;base64,'
                    f'{base64.b64encode(item.picture.png).decode()}">' for number, item in
                    enumerate(self._items[:most], 1))
        return _html.table(["", "name"], enumerate(self.names, 1)) + "".join(pictures)

    def __repr__(self) -> str:
        shown = [repr(item) for item in self._items[:3]] + ["..."] * (len(self) > 3)
        return f"<Drawings: {', '.join(shown)}>"


def view(model: _programs.Name, weather: _programs.Name | None = None, *, at: str | None = None,
         day: str | None = None, sun: tuple[float, float] | None = None, receiver: str | None = None,
         camera: tuple[float, float] | None = None, size: int | None = None) -> Picture:
    """Draws a model, or one `receiver`, as the sun sees it: `at` "06-21 15:00", over a `day` "06-21", or with the `sun`
    at an azimuth and altitude in degrees. `camera`: draw it as seen from this azimuth and altitude, with its shadows.
    `size`: pixels on the longer side."""
    if sum(value is not None for value in (at, day, sun)) != 1:
        raise InvalidInput("view: expected one of at, day and sun")
    arguments = _programs.inputs(model, weather) + _programs.flags(
        at=at, day=day, sun=_pair(sun), receiver=receiver, camera=_pair(camera), size=size)
    with tempfile.TemporaryDirectory(prefix="gpu_shading_view_") as folder:
        _programs.gpu_shading(["view", *arguments, "-o", Path(folder) / "view.png"])
        return Picture((Path(folder) / "view.png").read_bytes())


def map(model: _programs.Name, weather: _programs.Name, *, first: str | None = None, last: str | None = None,
        receivers: str | None = None, spacing: float = 0.25, rays: int = 4) -> Drawings[Map]:
    """Maps sunlit hours and beam energy over receivers whose names match a pattern, from the `first` day "06-01" to the
    `last`, in cells of `spacing` m, as `gpu_shading map` does."""
    arguments = _programs.inputs(model, weather) + _programs.flags(
        spacing=spacing, rays=rays, **{"from": first}, to=last, receivers=receivers)
    with tempfile.TemporaryDirectory(prefix="gpu_shading_map_") as temporary:
        folder = Path(temporary) / "maps"
        _programs.gpu_shading(["map", *arguments, "-o", folder])
        made = []
        for row in rows_of(folder / "maps.csv"):
            hours, energy = np.load(folder / f"{row['files']}.npy").astype(np.float64)
            made.append(Map(row["receiver"], hours, energy, float(row["sunlit mean [h]"]),
                            float(row["beam mean [kWh/m2]"]), _picture(folder / f"{row['files']}.png"),
                            _centres(folder / f"{row['files']}.csv", hours.shape), _normal(row),
                            (float(row["cell width [m]"]), float(row["cell height [m]"]))))
        return Drawings(made)


def mask(model: _programs.Name, weather: _programs.Name | None = None, *, receiver: str | None = None,
         points: float | None = None, projection: Projection = "stereographic", step: int = 2, rays: int = 32,
         beam: float = 300.0, samples: _programs.Name | None = None) -> Drawings[Mask]:
    """Draws the shading masks of windows, or of the receivers whose names match a pattern, as `gpu_shading mask` does.
    `points`: draw masks of the points of a grid with this spacing, m. `step`: of azimuth and altitude, degrees. `beam`:
    mark hours with at least this direct normal irradiance, W/m2, by the weather file or, without one, a clear sky.
    `samples`: the folder of a sample() of the model, whose sunlit fractions the hours have, with schedules."""
    arguments = _programs.inputs(model, weather) + _programs.flags(
        projection=projection, step=step, rays=rays, beam=beam, receiver=receiver, points=points,
        samples=None if samples is None else str(samples))
    with tempfile.TemporaryDirectory(prefix="gpu_shading_mask_") as temporary:
        folder = Path(temporary) / "masks"
        _programs.gpu_shading(["mask", *arguments, "-o", folder])
        hours: dict[str, list[MaskHour]] = {}
        for row in rows_of(folder / "hours.csv"):
            hours.setdefault(row["receiver"], []).append(_hour(row))
        return Drawings([_mask(folder, row, step, hours[row["receiver"]]) for row in rows_of(folder / "masks.csv")])


def screen(model: _programs.Name, name: str | None = None) -> Drawings[Sheet]:
    """Describes the perforated screens of a model, or those whose names match a pattern, as `gpu_shading screen`
    does."""
    arguments: list[str | Path] = [_programs.file(model, "model"), *([] if name is None else [name])]
    with tempfile.TemporaryDirectory(prefix="gpu_shading_screen_") as temporary:
        folder = Path(temporary)
        text = _programs.gpu_shading(["screen", *arguments, "-o", folder])
        return Drawings([_sheet(folder, table.name.removesuffix("_tau.csv"), text)
                         for table in sorted(folder.glob("*_tau.csv"))])


def _pair(angles: tuple[float, float] | None) -> str | None:
    return None if angles is None else f"{angles[0]},{angles[1]}"


def _picture(file: Path) -> Picture:
    # Installations without the picture formats write none.
    return Picture(file.read_bytes() if file.is_file() else b"")


def _centres(file: Path, shape: tuple[int, ...]) -> Floats:
    centres = np.full((*shape, 3), np.nan)
    for cell in rows_of(file):
        centres[int(cell["row"]), int(cell["column"])] = [float(cell[f"{axis} [m]"]) for axis in "xyz"]
    return centres


def _normal(row: dict[str, str]) -> Floats:
    azimuth, tilt = np.radians(float(row["azimuth [deg]"])), np.radians(float(row["tilt [deg]"]))
    return np.array([np.sin(azimuth) * np.sin(tilt), np.cos(azimuth) * np.sin(tilt), np.cos(tilt)])


def _hour(row: dict[str, str]) -> MaskHour:
    lit = row["sunlit fraction"]
    return MaskHour(int(row["month"]), int(row["hour"]), float(row["sun azimuth [deg]"]),
                    float(row["sun altitude [deg]"]), float(lit) if lit else None,
                    {kind: float(row[kind]) for kind in Kinds} if lit else {}, float(row["beam [W/m2]"]),
                    row["marked"] == "yes")


def _mask(folder: Path, row: dict[str, str], step: int, hours: list[MaskHour]) -> Mask:
    azimuths, altitudes = (np.arange(0.5 * step, most, step) for most in (360.0, 90.0))
    sky = np.full((len(altitudes), len(azimuths)), np.nan)
    for cell in rows_of(folder / f"{row['files']}.csv"):
        sky[int(float(cell["altitude [deg]"]) // step), int(float(cell["azimuth [deg]"]) // step)] = float(
            cell["sunlit fraction"])
    horizon = np.loadtxt(folder / f"{row['files']}.hor")[:, 1]
    return Mask(row["receiver"], float(row["sky view factor"]), float(row["unshaded view factor"]),
                {kind: float(row[kind]) for kind in Kinds}, azimuths, altitudes, sky, horizon, tuple(hours),
                _picture(folder / f"{row['files']}.png"),
                (folder / f"{row['files']}.svg").read_text(encoding="utf-8"))


def _sheet(folder: Path, stem: str, text: str) -> Sheet:
    rows = rows_of(folder / f"{stem}_tau.csv")
    values = np.array([[float(row[key]) for key in list(row)[:3]] for row in rows])
    theta, phi = np.unique(values[:, 0]), np.unique(values[:, 1])
    tau = np.full((len(theta), len(phi)), np.nan)
    tau[np.searchsorted(theta, values[:, 0]), np.searchsorted(phi, values[:, 1])] = values[:, 2]
    return Sheet(stem, text, theta, phi, tau, _picture(folder / f"{stem}_tile.png"),
                 (folder / f"{stem}_tau.svg").read_text(encoding="utf-8"))
