"""Runs of a Honeybee model with rendered shading, and their results as Honeybee has them."""

from __future__ import annotations

import importlib
import json
import re
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from honeybee_gpushading.writer import model_to_gpu_shading, schedules_to_idf

if TYPE_CHECKING:
    import os

    import gpu_shading

    Name = str | os.PathLike[str]

SUNLIT = "Surface Outside Face Sunlit Fraction"


@dataclass(frozen=True)
class Results:
    """A run of a model."""

    model: Any
    run: gpu_shading.Run

    def data(self, output: str) -> list[Any]:
        """An output variable as data collections of ladybug: HourlyContinuousCollection for hours and timesteps."""
        sql = importlib.import_module("ladybug.sql").SQLiteResult(str(self.run.folder / "eplusout.sql"))
        return list(sql.data_collections_by_output_name(output))

    def faces(self, output: str = SUNLIT) -> list[tuple[Any, Any]]:
        """(face, aperture or door, data collection) for an output variable of surfaces."""
        match = importlib.import_module("honeybee_energy.result.match")
        return list(match.match_faces_to_data(self.data(output), self.model.faces))


@dataclass(frozen=True)
class SunHours:
    """Maps of a model: a sensor grid for each receiver, and values in the order of its sensors."""

    grids: tuple[Any, ...]
    """honeybee_radiance.sensorgrid.SensorGrid, with meshes, for model.properties.radiance.add_sensor_grids."""
    hours: tuple[tuple[float, ...], ...]
    energy: tuple[tuple[float, ...], ...]
    """Beam solar energy, kWh/m2."""

    def write(self, folder: Name) -> None:
        """As results of grids: folders with grids_info.json, vis_metadata.json and a .res file for each grid, as
        Honeybee's recipes write them and honeybee-display reads them."""
        from gpu_shading._files import staged

        hours = importlib.import_module("ladybug.datatype.time").Time("Sun Hours")
        energy = importlib.import_module("ladybug.datatype.energyintensity").EnergyIntensity("Beam Energy")
        for name, kind, unit, values in (("sun_hours", hours, "hr", self.hours),
                                         ("beam_energy", energy, "kWh/m2", self.energy)):
            target = Path(folder) / name
            target.mkdir(parents=True, exist_ok=True)
            infos = [{"name": grid.identifier, "identifier": grid.identifier, "full_id": grid.identifier,
                      "count": grid.count, "group": ""} for grid in self.grids]
            metadata = {"type": "VisualizationMetaData", "data_type": kind.to_dict(), "unit": unit}
            with staged(target / "grids_info.json") as temporary:
                temporary.write_text(json.dumps(infos, indent=1), encoding="utf-8")
                temporary.with_name("vis_metadata.json").write_text(json.dumps(metadata, indent=1), encoding="utf-8")
                for grid, of_grid in zip(self.grids, values, strict=True):
                    lines = "".join(f"{value:.6g}\n" for value in of_grid)
                    temporary.with_name(f"{grid.identifier}.res").write_text(lines, encoding="utf-8")


def write_idf(model: Any, file: Name, weather: Name, parameters: Any = None) -> None:
    """Writes a model for EnergyPlus, and its GPUShading objects beside it, as MODEL.gpu-shading.idf. `parameters`: a
    SimulationParameter of honeybee-energy; without one, energy by zone and sunlit fractions are reported by the hour.
    Design days that it lacks are those of the weather file."""
    from gpu_shading._files import staged

    climate = importlib.import_module("ladybug.epw").EPW(str(weather))
    energyplus = importlib.import_module("honeybee_energy.writer")
    text = "\n\n".join([f"Version, {_release()};", climate.location.to_idf(), _parameters(parameters, climate).to_idf(),
                        energyplus.model_to_idf(model), schedules_to_idf(model)])
    path = Path(file)
    path.parent.mkdir(parents=True, exist_ok=True)
    with staged(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
        temporary.with_suffix(".gpu-shading.idf").write_text(model_to_gpu_shading(model), encoding="utf-8")


def run(model: Any, weather: Name, folder: Name | None = None, parameters: Any = None, *,
        arguments: Sequence[str] = (), **options: Any) -> Results:
    """Writes a model into a folder, new or empty, and runs it. `parameters` as write_idf has them; `options` as
    gpu_shading.run has them, such as shading=False for EnergyPlus's own polygon clipping."""
    from gpu_shading.runs import empty_folder

    import gpu_shading

    place = empty_folder(folder)
    write_idf(model, place / "model.idf", weather, parameters)
    return Results(model, gpu_shading.run(place / "model.idf", weather, place / "out", arguments=["-x", *arguments],
                                          **options))


def sun_hours(model: Any, weather: Name, **options: Any) -> SunHours:
    """Maps sunlit hours and beam energy over faces, apertures and doors; `options` as gpu_shading.map has them: first
    and last day, receivers, spacing. Needs honeybee-radiance. Grids are in metres."""
    import gpu_shading

    with tempfile.TemporaryDirectory(prefix="gpu_shading_honeybee_") as folder:
        write_idf(model, Path(folder) / "model.idf", weather)
        maps = gpu_shading.map(Path(folder) / "model.idf", weather, **options)
    names = {part.identifier.upper(): part.identifier for face in model.faces
             for part in (face, *face.apertures, *face.doors)}
    names |= {shade.identifier.upper(): shade.identifier for shade in model.shades}
    grids: list[Any] = []
    hours, energy = [], []
    for drawn in maps:
        cells = drawn.hours == drawn.hours
        taken = {grid.identifier for grid in grids}
        grids.append(_grid(names.get(drawn.name.upper(), drawn.name), drawn, cells, taken))
        hours.append(tuple(map(float, drawn.hours[cells])))
        energy.append(tuple(map(float, drawn.energy[cells])))
    return SunHours(tuple(grids), tuple(hours), tuple(energy))


def _grid(name: str, drawn: gpu_shading.Map, cells: Any, taken: set[str]) -> Any:
    import numpy as np

    sensor_grid = importlib.import_module("honeybee_radiance.sensorgrid").SensorGrid
    mesh = importlib.import_module("ladybug_geometry.geometry3d.mesh").Mesh3D
    point = importlib.import_module("ladybug_geometry.geometry3d.pointvector").Point3D
    across, up = _axes(drawn)
    width, height = drawn.cell_size
    corners = [(-width, -height), (width, -height), (width, height), (-width, height)]
    vertices = np.concatenate([[centre + 0.5 * (u * across + v * up) for u, v in corners]
                               for centre in drawn.centres[cells]])
    faces = [tuple(range(first, first + 4)) for first in range(0, len(vertices), 4)]
    made = mesh(tuple(point(*map(float, vertex)) for vertex in vertices), faces)
    identifier = re.sub(r"\W", "_", name)
    while identifier in taken:
        identifier += "_"
    grid = sensor_grid.from_mesh3d(identifier, made)
    grid.display_name = name
    return grid


def _axes(drawn: gpu_shading.Map) -> tuple[Any, Any]:
    """Unit vectors along the rows and the columns of a map."""
    import numpy as np

    def step(axis: int) -> Any:
        steps = np.diff(drawn.centres, axis=axis).reshape(-1, 3)
        steps = steps[~np.isnan(steps[:, 0])]
        return steps[0] / np.linalg.norm(steps[0]) if len(steps) else None

    across, up = step(1), step(0)
    if across is None and up is None:
        level = np.cross([0.0, 0.0, 1.0], drawn.normal)
        length = np.linalg.norm(level)
        across = level / length if length > 1e-9 else np.array([1.0, 0.0, 0.0])
    if across is None:
        across = np.cross(up, drawn.normal)
    return across, np.cross(drawn.normal, across) if up is None else up


def _parameters(parameters: Any, climate: Any) -> Any:
    if parameters is None:
        parameters = importlib.import_module("honeybee_energy.simulation.parameter").SimulationParameter()
        parameters.output.add_zone_energy_use()
        parameters.output.add_output(SUNLIT)
    if parameters.sizing_parameter.design_days:
        return parameters
    parameters = parameters.duplicate()
    for kind in ("WinterDesignDay", "SummerDesignDay"):
        parameters.sizing_parameter.add_design_day(climate.approximate_design_day(kind))
    return parameters


def _release() -> str:
    """The EnergyPlus that runs, as in its dictionary: the major and the minor number."""
    import gpu_shading

    with open(gpu_shading.prefix() / "Energy+.idd", encoding="utf-8", errors="replace") as lines:
        first = next(lines)
    return ".".join(first.split()[-1].split(".")[:2])
