"""Power of photovoltaic modules with partly shaded cells, by pvlib: irradiance on the plane, one-diode model and
reverse characteristic of cells are pvlib's. Cells of a module are in series, or in two halves of which each pair of
submodules is in parallel; each bypass diode conducts at 0.5 V, modules of a string are in series, and each string has
a maximum power point tracker of its own."""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gpu_shading import _programs
from gpu_shading._arrays import Floats, number
from gpu_shading._files import write_whole
from gpu_shading.errors import InvalidInput
from gpu_shading.pv_modules import Integers, ModuleField, Modules, _frame, _write
from gpu_shading.pv_picture import draw

_PARAMETERS = ("alpha_sc", "a_ref", "I_L_ref", "I_o_ref", "R_sh_ref", "R_s", "Adjust")
# Reverse characteristic of a crystalline cell, as in pvlib's example "Calculating power loss from partial module
# shading".
REVERSE = {"breakdown_factor": 2e-3, "breakdown_exp": 3.0, "breakdown_voltage": -15.0}
_BYPASS = -0.5  # V
_LEVELS = 500  # of irradiance, by which cells of one time are told apart
_POINTS = 400  # of a curve


@dataclass(frozen=True, repr=False)
class Power:
    """The power of the modules on one surface at the times of Modules, W. `with` mismatch, cells have their own
    irradiance; `without`, that of the mean of the module, the string or the surface."""

    name: str
    """Of the surface."""
    clock: Integers
    """Month, day, hour (1 to 24) and timestep (from 1) of each time."""
    times: Any
    module_with: Floats
    """Times x modules, each at its own maximum power point."""
    module_without: Floats
    string_with: Floats
    """Times x strings."""
    string_without: Floats
    surface_with: Floats
    """The sum of the strings."""
    surface_without: Floats
    sunlit: Floats
    """Mean beam sunlit fraction of the surface's cells."""
    reduction: Floats
    """Of the sunlit fraction, by which the irradiance of the surface is reduced in the ratio of with to without
    mismatch."""
    beam_reduction: Floats
    """The same where the circumsolar part of the sky's light is not shaded."""
    positions: Integers
    """Column and row of each module, from 0."""
    steps_per_hour: int

    @property
    def loss(self) -> float:
        """The share of energy that mismatch takes from the surface."""
        whole = self.surface_without.sum()
        return float(1.0 - self.surface_with.sum() / whole) if whole > 0 else 0.0

    @property
    def energy(self) -> float:
        """With mismatch, kWh."""
        return float(self.surface_with.sum() / self.steps_per_hour / 1000)

    def frame(self) -> Any:
        """A pandas DataFrame by (level, number, mismatch), W: the surface, its strings and its modules."""
        columns, values = [], []
        for level, pair in (("surface", (self.surface_with[:, None], self.surface_without[:, None])),
                            ("string", (self.string_with, self.string_without)),
                            ("module", (self.module_with, self.module_without))):
            for kind, array in zip(("with", "without"), pair, strict=True):
                columns += [(level, number + 1, kind) for number in range(array.shape[1])]
                values.append(array)
        return _frame(np.concatenate(values, axis=1), self.times, columns, ["level", "number", "mismatch"])

    def write(self, file: _programs.Name) -> None:
        """Writes frame() as Parquet."""
        _write(self.frame(), file)

    def svg(self, string: int = 0) -> str:
        """A picture: modules by the share of energy that mismatch takes, and the loss of a string by day and hour."""
        return draw(self, string)

    def _repr_html_(self) -> str:
        return self.svg()

    def __repr__(self) -> str:
        return f"<Power of {self.name}: {self.energy:.1f} kWh, {self.loss:.1%} lost by mismatch>"


def power(modules: Modules, module: str | Mapping[str, float], *, albedo: float = 0.2,
          reverse: Mapping[str, float] = REVERSE) -> tuple[Power, ...]:
    """The power of each field of modules() with pvlib.

    `module`: the name of a module in pvlib's table of the CEC, or its parameters: alpha_sc, a_ref, I_L_ref, I_o_ref,
    R_sh_ref, R_s, Adjust and N_s, the number of cells in series. `reverse`: of pvlib's bishop88(). The sky is Perez's,
    whose circumsolar part is shaded like the beam, and the rest by each module's view of the sky. The temperature of
    cells is Faiman's, one for a surface.
    """
    if missing := [key for key in REVERSE if key not in reverse]:
        raise InvalidInput(f"reverse: {', '.join(missing)} missing")
    limits = {**reverse, **{key: number(reverse[key], f"reverse: {key}") for key in REVERSE}}
    albedo = number(albedo, "albedo", 0.0, 1.0)
    return tuple(_power(field, modules, _parameters(module), albedo, limits) for field in modules)


def write_reductions(powers: Sequence[Power], file: _programs.Name) -> None:
    """Writes the reductions of sunlit fractions, for `energyplus --gpu-shading-pv FILE` and run()."""
    lines = ["month,day,hour,timestep,reduction,PVWatts,surface\n"]
    for each in powers:
        for clock, *reductions in zip(each.clock, each.reduction, each.beam_reduction, strict=True):
            numbers = [*map(str, clock), *(f"{reduction:.6f}" for reduction in reductions)]
            lines.append(f"{','.join(numbers)},{each.name}\n")
    write_whole(file, "".join(lines))


def _pvlib(part: str) -> Any:
    try:
        return importlib.import_module(f"pvlib.{part}")
    except ImportError as error:
        raise ImportError(f"power needs pvlib: pip install pvlib ({error})") from None


def _parameters(module: str | Mapping[str, float]) -> dict[str, float]:
    given: Any = module
    if isinstance(module, str):
        table = _pvlib("pvsystem").retrieve_sam("CECMod")
        if module not in table:
            raise InvalidInput(f"module: {module!r} is not in pvlib's table of the CEC")
        given = table[module]
    missing = [key for key in (*_PARAMETERS, "N_s") if key not in given]
    if missing:
        raise InvalidInput(f"module: {', '.join(missing)} missing")
    return {key: number(given[key], f"module: {key}") for key in (*_PARAMETERS, "N_s")}


@dataclass(frozen=True)
class _Irradiance:
    """On the plane, W/m2, by time."""

    direct: Floats
    """Of the beam alone."""
    beam: Floats
    """With the circumsolar part; shaded by cell."""
    sky: Floats
    """Shaded by module."""
    ground: Floats


def _irradiance(field: ModuleField, modules: Modules, albedo: float) -> _Irradiance:
    irradiance, atmosphere = _pvlib("irradiance"), _pvlib("atmosphere")
    zenith = 90.0 - modules.altitude
    days = (modules.times.astype("datetime64[D]") - modules.times.astype("datetime64[Y]")).astype(int) + 1
    parts = irradiance.perez(field.tilt, field.azimuth, modules.diffuse, modules.beam,
                             irradiance.get_extra_radiation(days), zenith, modules.azimuth,
                             atmosphere.get_relative_airmass(zenith), return_components=True)
    isotropic, around, horizon = (np.nan_to_num(np.asarray(parts[f"poa_{name}"], float))
                                  for name in ("isotropic", "circumsolar", "horizon"))
    cosine = np.maximum(irradiance.aoi_projection(field.tilt, field.azimuth, zenith, modules.azimuth), 0.0)
    direct = modules.beam * cosine
    beam = np.where(cosine > 0, direct + np.maximum(around, 0.0), 0.0)
    level = modules.beam * np.sin(np.radians(modules.altitude)) + modules.diffuse
    ground = irradiance.get_ground_diffuse(field.tilt, level, albedo)
    return _Irradiance(direct, beam, np.maximum(isotropic + horizon, 0.0), np.asarray(ground, float))


def _power(field: ModuleField, modules: Modules, parameters: Mapping[str, float], albedo: float,
           reverse: Mapping[str, float]) -> Power:
    rows, columns = field.cells.shape[2:]
    halves = 2 if field.half_cut else 1
    count = rows * columns // halves
    if parameters["N_s"] != count:
        raise InvalidInput(f"module: N_s is {parameters['N_s']:g}, but modules on {field.name} have {rows} x {columns} "
                           f"cells, {count} in series")
    light = _irradiance(field, modules, albedo)
    share = field.sky_view / field.unshaded_view
    times, number = field.cells.shape[:2]
    strings = int(field.strings.max()) + 1
    of_strings = np.bincount(field.strings)
    module_with, module_without = np.zeros((2, times, number))
    string_with, string_without = np.zeros((2, times, strings))
    surface_without, ratio = np.zeros(times), np.ones(times)
    sunlit = field.cells.mean(axis=(1, 2, 3)) / 65535
    diffuse = light.sky[:, None] * share + light.ground[:, None]
    mean = sunlit * light.beam + diffuse.mean(axis=1)
    cell = _pvlib("temperature").faiman(mean, modules.air, modules.wind)
    diode = np.arange(columns) // (columns // field.diodes)
    half = np.arange(rows)[:, None] // (rows // halves)
    block = ((np.arange(number)[:, None, None] * field.diodes + diode) * halves + half).ravel()
    for i in np.flatnonzero(mean > 0):
        lit = field.cells[i] / 65535
        cells = light.beam[i] * lit + diffuse[i][:, None, None]
        modules_mean = cells.mean(axis=(1, 2))
        strings_mean = np.bincount(field.strings, modules_mean) / of_strings
        level, place = _levels(cells.ravel())
        curves, current = _curves(np.concatenate([level, modules_mean, strings_mean, mean[i:i + 1]]), cell[i],
                                  parameters, reverse, backwards=halves > 1)
        counts = np.zeros((number * field.diodes * halves, len(level)))
        np.add.at(counts, (block, place), 1.0)
        voltage = counts @ curves[:len(level)]
        if halves > 1:
            voltage = _in_parallel(voltage.reshape(number * field.diodes, halves, -1), current)
        voltage = np.maximum(voltage, _BYPASS).reshape(number, field.diodes, -1).sum(axis=1)
        of_string = np.zeros((strings, voltage.shape[1]))
        np.add.at(of_string, field.strings, voltage)
        uniform = (count * curves[len(level):] * current).max(axis=1)
        module_with[i] = (voltage * current).max(axis=1)
        string_with[i] = (of_string * current).max(axis=1)
        module_without[i] = uniform[:number]
        string_without[i] = uniform[number:-1] * of_strings
        surface_without[i] = uniform[-1] * number
        ratio[i] = string_with[i].sum() / surface_without[i] if surface_without[i] > 0 else 1.0
    # Of less than 1 W/m2, nothing is worth taking.
    reductions = [np.clip(np.where(shaded > 1.0, (1.0 - ratio) * mean / np.maximum(shaded, 1.0), 0.0), 0.0, sunlit)
                  for shaded in (light.beam, light.direct)]
    return Power(field.name, modules.clock, modules.times, module_with, module_without, string_with, string_without,
                 string_with.sum(axis=1), surface_without, sunlit, reductions[0], reductions[1],
                 field.positions, modules.steps_per_hour)


def _in_parallel(voltage: Floats, current: Floats) -> Floats:
    """Voltages of pairs in parallel at common currents. A half of a cell has the voltage of a whole one at half the
    current, so that the current of a pair is the mean of what whole cells would have."""
    found = voltage[:, 0].copy()
    for i in np.flatnonzero((voltage[:, 0] != voltage[:, 1]).any(axis=1)):
        volts = np.unique(np.maximum(voltage[i], _BYPASS))
        mean = sum(np.interp(volts, each[::-1], current[::-1]) for each in voltage[i]) / 2
        found[i] = np.interp(current, mean[::-1], volts[::-1])
    return found


def _levels(values: Floats) -> tuple[Floats, Integers]:
    """Irradiances that differ, each the mean of the cells that have it, and the one of each cell."""
    rounded = np.round(values * (_LEVELS / max(values.max(), 1e-9))).astype(int)
    _, place, counts = np.unique(rounded, return_inverse=True, return_counts=True)
    return np.bincount(place, values) / counts, place


def _curves(irradiance: Floats, temperature: float, parameters: Mapping[str, float],
            reverse: Mapping[str, float], backwards: bool) -> tuple[Floats, Floats]:
    """(voltages of cells of each irradiance, at common currents); `backwards`: at negative ones, too."""
    cells = parameters["N_s"]
    light, dark, series, shunt, thermal = _pvlib("pvsystem").calcparams_cec(
        np.maximum(irradiance, 1e-3), temperature, parameters["alpha_sc"], parameters["a_ref"] / cells,
        parameters["I_L_ref"], parameters["I_o_ref"], parameters["R_sh_ref"] / cells, parameters["R_s"] / cells,
        parameters["Adjust"])
    dark, series, thermal = (float(np.max(value)) for value in (dark, series, thermal))
    # From where the weakest cell passes the current of the brightest, to where none gives any.
    open_circuit = thermal * np.log(light.max() / dark + 1.0)
    lowest = 0.999 * reverse["breakdown_voltage"]
    points = np.concatenate([np.linspace(lowest, 0.9 * lowest, 100, endpoint=False),
                             np.linspace(0.9 * lowest, 0.0, 60, endpoint=False),
                             open_circuit * np.sin(np.linspace(0.0, np.pi / 2, 240))])
    found, voltage, _ = _pvlib("singlediode").bishop88(points, light[:, None], dark, series, shunt[:, None], thermal,
                                                       **reverse)
    brightest = float(light.max())
    current = np.linspace(0.0, brightest, _POINTS)
    if backwards:
        current = np.concatenate([-current[:0:-1], current])
    return np.stack([np.interp(current, row[::-1], volts[::-1])
                     for row, volts in zip(found, voltage, strict=True)]), current
