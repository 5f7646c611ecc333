"""Photovoltaic modules of a model of EnergyPlus: which of their cells the sun reaches, and when."""

from __future__ import annotations

import importlib
import json
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gpu_shading import _programs
from gpu_shading._arrays import Floats, number, numbers, whole, within
from gpu_shading._files import staged
from gpu_shading._reading import array_of, reading, rows_of, shares, text_of
from gpu_shading.drawings import Picture, _picture
from gpu_shading.errors import InvalidInput

_FORMAT = "gpu_shading modules 1"
_MOST_PLACES = 99_999
_MOST_VIEW = 1.01  # a sum over directions
_CLOCK = {"month": 12, "day": 31, "hour": 24, "timestep": 60}
_COLUMNS = (*_CLOCK, "sun azimuth [deg]", "sun altitude [deg]", "beam [W/m2]", "diffuse [W/m2]", "air [C]",
            "wind [m/s]")
Integers = NDArray[np.int64]


@dataclass(frozen=True, repr=False)
class ModuleField:
    """The modules of one surface. Modules are in order of their strings."""

    name: str
    """Of the surface."""
    cells: NDArray[np.uint16]
    """Beam sunlit fraction of times x modules x cell rows x cell columns; 65535 is sunlit."""
    strings: Integers
    """The string of each module, from 0."""
    positions: Integers
    """Column and row of each module, from 0."""
    azimuth: float
    tilt: float
    """Degrees."""
    sky_view: Floats
    """View factor of each module to the sky."""
    unshaded_view: float
    diodes: int
    """Bypass diodes of a module; each protects as many columns of cells."""
    half_cut: bool
    """Whether the lower and the upper half of the rows are in parallel, at each bypass diode."""
    module_area: float
    """m2."""
    picture: Picture

    @property
    def sunlit(self) -> Floats:
        """Mean beam sunlit fraction of each module: times x modules."""
        return np.asarray(self.cells.mean(axis=(2, 3)) / 65535)

    def blocks(self) -> Integers:
        """The number of bypass diodes of each module with a cell that is partly shaded: times x modules."""
        times, modules, rows, columns = self.cells.shape
        blocks = self.cells.reshape(times, modules, rows, self.diodes, columns // self.diodes).min(axis=(2, 4))
        return np.asarray((blocks < 0.999 * 65535).sum(axis=-1))

    def _repr_png_(self) -> bytes:
        return self.picture.png

    def __repr__(self) -> str:
        return f"<ModuleField {self.name}: {self.cells.shape[1]} modules of {self.cells[0, 0].size} cells>"


class Modules(Sequence[ModuleField]):
    """What modules() returns: the fields, by position or by name of the surface in any case, and their times."""

    def __init__(self, fields: Sequence[ModuleField], table: Sequence[dict[str, str]], year: int, steps: int) -> None:
        self._fields = tuple(fields)
        values = {key: numbers([float(row[key]) for row in table], key) for key in _COLUMNS}
        clock = [within(values[key], key, 1, most) for key, most in _CLOCK.items()]
        self.clock: Integers = np.stack(clock, axis=1).astype(int)
        """Month, day, hour (1 to 24) and timestep (from 1) of each time."""
        self.steps_per_hour = steps
        days = [f"{year:04}-{month:02}-{day:02}" for month, day in self.clock[:, :2]]
        self.times: NDArray[np.datetime64] = np.array(days, "datetime64[m]") + (
            60 * (self.clock[:, 2] - 1) + 60 * self.clock[:, 3] // steps).astype("timedelta64[m]")
        """The ends of the timesteps with the sun up, standard time."""
        self.azimuth: Floats = values["sun azimuth [deg]"]
        self.altitude: Floats = values["sun altitude [deg]"]
        self.beam: Floats = values["beam [W/m2]"]
        """Direct normal irradiance, W/m2."""
        self.diffuse: Floats = values["diffuse [W/m2]"]
        """Diffuse horizontal irradiance, W/m2."""
        self.air: Floats = values["air [C]"]
        self.wind: Floats = values["wind [m/s]"]

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return self._fields[key]
        for field in self._fields:
            if field.name.upper() == key.upper():
                return field
        raise KeyError(f"{key}: expected one of {', '.join(field.name for field in self._fields)}")

    def __len__(self) -> int:
        return len(self._fields)

    def frame(self) -> Any:
        """A pandas DataFrame of the sunlit fraction of each module, with columns (surface, string, column, row)."""
        columns = [(field.name, string + 1, column + 1, row + 1) for field in self._fields
                   for string, (column, row) in zip(field.strings, field.positions, strict=True)]
        return _frame(np.concatenate([field.sunlit for field in self._fields], axis=1), self.times,
                      columns, ["surface", "string", "column", "row"])

    def write(self, file: _programs.Name) -> None:
        """Writes frame() as Parquet."""
        _write(self.frame(), file)

    def __repr__(self) -> str:
        return f"<Modules: {len(self.times)} times, {', '.join(map(repr, self._fields))}>"


def modules(model: _programs.Name, weather: _programs.Name, folder: _programs.Name | None = None, *,
            first: str | None = None, last: str | None = None) -> Modules:
    """Shades the cells of the model's GPUShading:PVModules from the `first` day "06-01" to the `last`, as
    `gpu_shading modules` does, and reads what it writes. `folder`: where that is kept."""
    arguments = _programs.inputs(model, weather) + _programs.flags(**{"from": first}, to=last)
    with tempfile.TemporaryDirectory(prefix="gpu_shading_modules_") as temporary:
        kept = _programs.folder(folder, Path(temporary) / "modules")
        _programs.gpu_shading(["modules", *arguments, "-o", kept])
        return read_modules(kept)


def read_modules(folder: _programs.Name) -> Modules:
    """What `gpu_shading modules` wrote into a folder."""
    path = Path(folder)
    for name in ("modules.json", "modules.csv", "times.csv"):
        if not (path / name).exists():
            raise InvalidInput(f"{path}: has no {name}: run gpu_shading modules")
    with reading(path, "a folder of gpu_shading modules"):
        about = json.loads(text_of(path / "modules.json"))
        if about["format"] != _FORMAT:
            raise ValueError(f"its format is {about['format']!r}, expected {_FORMAT!r}")
        rows, times = rows_of(path / "modules.csv"), rows_of(path / "times.csv")
        return Modules([_field(path, each, [row for row in rows if row["surface"] == each["surface"]], len(times))
                        for each in about["fields"]], times, whole(about["year"], "year", 1, 9999),
                       whole(about["steps_per_hour"], "steps_per_hour", 1, 60))


def _field(path: Path, about: dict[str, Any], rows: list[dict[str, str]], times: int) -> ModuleField:
    stem = str(about["files"])
    if Path(stem).name != stem:
        raise ValueError(f"files: {stem!r}, expected the name of a file")
    cells = array_of(path / f"{stem}.npy")
    wanted = (times, len(rows), about["cell_rows"], about["cell_columns"])
    if cells.dtype != np.uint16 or cells.shape != wanted:
        raise ValueError(f"{stem}.npy, modules.csv and times.csv differ")
    places = np.array([[int(row[name]) - 1 for name in ("string", "column", "row")] for row in rows])
    if places.min(initial=0) < 0 or places.max(initial=0) > _MOST_PLACES:
        raise ValueError(f"string, column or row: expected 1 to {_MOST_PLACES + 1}")
    return ModuleField(
        str(about["surface"]), cells, places[:, 0], places[:, 1:], number(float(rows[0]["azimuth [deg]"]), "azimuth"),
        number(float(rows[0]["tilt [deg]"]), "tilt"),
        shares([row["sky view factor"] for row in rows], "sky view factor", _MOST_VIEW),
        number(float(rows[0]["unshaded view factor"]), "unshaded view factor", 0.0, _MOST_VIEW),
        whole(about["bypass_diodes"], "bypass_diodes", 1, about["cell_columns"]), bool(about["half_cut"]),
        number(about["module_area"], "module_area", 0.0), _picture(path / f"{stem}.png"))


def _frame(values: Floats, times: NDArray[np.datetime64], columns: list[Any], names: list[str]) -> Any:
    try:
        pandas = importlib.import_module("pandas")
    except ImportError:
        raise ImportError("frames need pandas: pip install pandas") from None
    return pandas.DataFrame(values, index=pandas.DatetimeIndex(times, name="time"),
                            columns=pandas.MultiIndex.from_tuples(columns, names=names))


def _write(frame: Any, file: _programs.Name) -> None:
    if Path(file).suffix != ".parquet":
        raise InvalidInput(f"{file}: expected a name that ends in .parquet")
    # Names of columns in Parquet are text.
    frame.columns = [" ".join(map(str, column)) for column in frame.columns]
    with staged(file) as temporary:
        frame.to_parquet(temporary)
