"""Sunlit fractions of a year, sampled as --gpu-shading-update sampled:... does, as an xarray Dataset."""

from __future__ import annotations

import csv
import importlib
import json
import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from gpu_shading import _programs
from gpu_shading._files import staged
from gpu_shading._reading import reading, regular, shares, text_of
from gpu_shading.errors import InvalidInput

if TYPE_CHECKING:
    import xarray

Mode = Literal["fine", "medium", "coarse"]
_FORMAT = "gpu_shading samples 1"
_OF_NETCDF = 100_000  # bytes beside the arrays


def sample(model: _programs.Name, weather: _programs.Name, folder: _programs.Name | None = None, *,
           mode: Mode = "medium") -> xarray.Dataset:
    """Samples a year's sunlit fractions by `gpu_shading sample`, and returns them as read_samples() does.

    `folder`: where the tables are kept, so that an interrupted call can resume. `mode`: "fine", "medium" or "coarse".
    """
    _xarray()
    arguments: list[str | Path] = ["sample", _programs.file(model, "model"), "-w", _programs.file(weather, "weather"),
                                   "--mode", mode]
    with tempfile.TemporaryDirectory(prefix="gpu_shading_samples_") as temporary:
        kept = _programs.folder(folder, Path(temporary))
        _programs.gpu_shading([*arguments, "-o", kept])
        return read_samples(kept)


def read_samples(folder: _programs.Name) -> xarray.Dataset:
    """The tables of `gpu_shading sample` as a Dataset.

    Dimensions are `time`, every 15 minutes of the year at the end of the timestep in standard time; `receiver`; and
    `axis`, x, y, z. Variables: `sunlit_fraction` (time, receiver), 0 to 1; `azimuth` and `altitude` (time) of the sun
    in degrees; `area` (receiver) in m2; and `normal` (receiver, axis). Attributes name mode, model, weather file, site
    and version.
    """
    dataset = _xarray().Dataset
    tables = Path(folder)
    for name in ("samples.json", "year.csv"):
        if not (tables / name).exists():
            raise InvalidInput(f"{tables}: has no {name}: run gpu_shading sample")
    with reading(tables, "a folder of gpu_shading sample"):
        about = json.loads(text_of(tables / "samples.json"))
        receivers = [str(receiver["name"]) for receiver in about["receivers"]]
        times, numbers = _year(tables / "year.csv", receivers)
        if about["format"] != _FORMAT:
            raise ValueError(f"its format is {about['format']!r}, expected {_FORMAT!r}")
        made: xarray.Dataset = dataset(
            {
                "sunlit_fraction": (("time", "receiver"), shares(numbers[:, 2:], "sunlit fractions"),
                                    {"units": "1", "long_name": "sunlit fraction"}),
                "azimuth": ("time", numbers[:, 0], {"units": "degree", "long_name": "azimuth, clockwise from north"}),
                "altitude": ("time", numbers[:, 1], {"units": "degree", "long_name": "altitude, from the horizon"}),
                "area": ("receiver", [receiver["area"] for receiver in about["receivers"]], {"units": "m2"}),
                "normal": (("receiver", "axis"),
                           np.array([receiver["normal"] for receiver in about["receivers"]]).reshape(-1, 3)),
            },
            coords={"time": times, "receiver": receivers, "axis": ["x", "y", "z"]},
            attrs={"mode": about["mode"], "fineness": about["fineness"], "model": about["inputs"]["model"]["name"],
                   "weather": about["inputs"]["weather"]["name"], "latitude": about["site"]["latitude"],
                   "longitude": about["site"]["longitude"], "gpu_shading": about["versions"]["gpu_shading"]})
        return made


def write_samples(dataset: xarray.Dataset, file: _programs.Name) -> None:
    """Writes a Dataset as NetCDF (.nc), or its sunlit fractions as a table of times and receivers in Parquet
    (.parquet). An existing file is replaced."""
    path = Path(file)
    if path.suffix not in (".nc", ".parquet"):
        raise InvalidInput(f"{path}: expected a name that ends in .nc or .parquet")
    with staged(path) as temporary:
        if path.suffix == ".nc":
            _require_room(temporary, dataset.nbytes + dataset.nbytes // 8 + _OF_NETCDF)
            dataset.to_netcdf(temporary)
        else:
            dataset["sunlit_fraction"].to_pandas().to_parquet(temporary)


def _require_room(file: Path, count: int) -> None:
    """HDF5 ends the process by a segmentation fault when a disk gets full."""
    with open(file, "xb") as room:
        os.posix_fallocate(room.fileno(), 0, count)
    file.unlink()


def _year(file: Path, receivers: list[str]) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, np.dtype[np.float64]]]:
    """(times; azimuth, altitude and each receiver's fraction in rows)"""
    with open(regular(file), newline="", encoding="utf-8") as lines:
        rows = csv.reader(lines)
        header = next(rows, [])
        if header != ["time", "azimuth", "altitude", *receivers]:
            raise ValueError(f"{file.name} and samples.json have other receivers")
        table = list(rows)
    if any(len(row) != len(header) for row in table):
        raise ValueError(f"{file.name} has rows of another length")
    times = np.array([row[0] for row in table], dtype="datetime64[s]").astype("datetime64[ns]")
    return times, np.array([row[1:] for row in table], dtype=np.float64).reshape(-1, len(header) - 1)


def _xarray() -> Any:
    try:
        return importlib.import_module("xarray")
    except ImportError:
        raise ImportError("samples need xarray: pip install xarray") from None
