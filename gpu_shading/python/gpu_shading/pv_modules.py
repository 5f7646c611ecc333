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
from gpu_shading._arrays import Floats
from gpu_shading.drawings import Picture, _picture, _rows
from gpu_shading.errors import InvalidInput

_FORMAT = "gpu_shading modules 1"
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
        values = {key: np.array([float(row[key]) for row in table]) for key in (table[0] if table else ())}
        self.clock: Integers = np.stack([values[key] for key in ("month", "day", "hour", "timestep")], 1).astype(int)
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
        kept = Path(folder or Path(temporary) / "modules").absolute()
        _programs.gpu_shading(["modules", *arguments, "-o", kept])
        return read_modules(kept)


def read_modules(folder: _programs.Name) -> Modules:
    """What `gpu_shading modules` wrote into a folder."""
    path = Path(folder)
    try:
        about = json.loads((path / "modules.json").read_text(encoding="utf-8"))
        if about["format"] != _FORMAT:
            raise ValueError(f"its format is {about['format']!r}, expected {_FORMAT!r}")
        rows = _rows(path / "modules.csv")
        return Modules([_field(path, each, [row for row in rows if row["surface"] == each["surface"]])
                        for each in about["fields"]], _rows(path / "times.csv"), about["year"],
                       about["steps_per_hour"])
    except FileNotFoundError as error:
        raise InvalidInput(f"{path}: has no {Path(str(error.filename)).name}: run gpu_shading modules") from None
    except (KeyError, TypeError, ValueError, UnicodeDecodeError) as error:
        raise InvalidInput(f"{path}: is not a folder of gpu_shading modules: {error}") from None


def _field(path: Path, about: dict[str, Any], rows: list[dict[str, str]]) -> ModuleField:
    cells = np.load(path / f"{about['files']}.npy", allow_pickle=False)
    if cells.dtype != np.uint16 or cells.shape[1:] != (len(rows), about["cell_rows"], about["cell_columns"]):
        raise ValueError(f"{about['files']}.npy and modules.csv differ")
    return ModuleField(
        about["surface"], cells, np.array([int(row["string"]) - 1 for row in rows]),
        np.array([[int(row["column"]) - 1, int(row["row"]) - 1] for row in rows]), float(rows[0]["azimuth [deg]"]),
        float(rows[0]["tilt [deg]"]), np.array([float(row["sky view factor"]) for row in rows]),
        float(rows[0]["unshaded view factor"]), about["bypass_diodes"], about["half_cut"],
        about["module_area"], _picture(path / f"{about['files']}.png"))


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
    frame.to_parquet(file)
