"""Whole runs of EnergyPlus, and their results."""

from __future__ import annotations

import contextlib
import datetime
import importlib
import os
import re
import signal
import sqlite3
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gpu_shading import _html, _programs
from gpu_shading._arrays import Floats, number
from gpu_shading._reading import reading, regular, rows_of
from gpu_shading.errors import InvalidInput, RunError
from gpu_shading.pv import Power, write_reductions

_REPORT = "report"  # in the output folder
_MONTHS = "run_months.csv"
_FREQUENCIES = ("Each Call", "TimeStep", "Hourly", "Daily", "Monthly", "RunPeriod", "Annual")


@dataclass(frozen=True)
class ShadingErrors:
    """Errors of the sunlit fractions that a run was answered with, by view: a receiver at a direction of the sun."""

    target: float | None
    """None at a fixed resolution."""
    sampled: int
    """Views whose error was measured; 99 % of such fractions are within it."""
    within: float | None
    """What the errors of 99 % of these are within: 1e-7, which is rounding, if all views are exact; None if none was
    measured."""
    largest: float | None
    exact: int
    """Views that were answered without samples, within rounding."""
    not_measured: int
    """Sampled views whose error is not known."""


@dataclass(frozen=True)
class Summary:
    """Errors, time and energy of a run."""

    warnings: int
    severe: int
    seconds: float
    """Elapsed time, as EnergyPlus reports it."""
    messages: tuple[str, ...]
    """The lines of gpu_shading in eplusout.err."""
    variables: tuple[str, ...]
    """Output variables in eplusout.eso."""
    site_energy: float | None
    """Total Site Energy, kWh; None if the model does not ask for its tables in eplusout.sql."""
    light: dict[str, dict[str, float | None]]
    """Of a run with `report`: by receiver, the kinds of light of Run.light(), kWh/m2; None where it is not known."""
    shading: ShadingErrors | None
    """None if eplusout.eio does not state errors, as without `shading` or by the methods opengl and scheduled."""

    def _repr_html_(self) -> str:
        rows: list[tuple[str, object]] = [("Warnings", self.warnings), ("Severe errors", self.severe),
                                          ("Seconds", self.seconds), ("Site energy, kWh", self.site_energy)]
        if self.shading:
            rows.append(("Largest error of sunlit fractions", self.shading.largest))
        page = _html.table(["", ""], [*rows, *(("", line) for line in self.messages)])
        if not self.light:
            return page
        kinds = tuple(next(iter(self.light.values())))
        return page + _html.table(["Light, kWh/m2", *kinds],
                                  [(name, *kinds_of.values()) for name, kinds_of in self.light.items()])


@dataclass(frozen=True)
class Run:
    """A run that EnergyPlus completed."""

    folder: Path
    """The output folder: eplusout.eso, eplusout.err, ..."""
    messages: tuple[str, ...]
    """The lines of gpu_shading in eplusout.err: the device that rendered, warnings."""

    def values(self, variable: str, frequency: str | None = None) -> dict[str, Floats]:
        """Values of an output variable by key, such as {"WINDOW 1": array}, in the last environment of the run (the
        last run period, if there is one), from eplusout.eso. A variable for which the model has no Output:Variable
        raises InvalidInput. `frequency`: "Each Call", "TimeStep", "Hourly", "Daily", "Monthly", "RunPeriod" or
        "Annual", if the variable is reported at several."""
        if frequency is not None and frequency not in _FREQUENCIES:
            raise InvalidInput(f"frequency: {frequency!r}, expected one of {', '.join(_FREQUENCIES)}")
        keys: dict[str, str] = {}
        found: dict[str, list[float]] = {}
        path = self.folder / "eplusout.eso"
        with reading(path, "a file of EnergyPlus's results"), open(regular(path), encoding="utf-8",
                                                                    errors="replace") as lines:
            for line in lines:
                if line.startswith("End of Data Dictionary"):
                    break
                number, key = _entry(line, variable, frequency)
                if number:
                    keys[number] = key
            for line in lines:
                number, _, rest = line.partition(",")
                if number == "1":
                    found = {key: [] for key in keys.values()}
                elif number in keys:
                    found[keys[number]].append(float(rest.partition(",")[0]))
        if not keys:
            raise InvalidInput(f"{variable}: not in {path}: the model has no Output:Variable for it")
        return {key: np.array(values) for key, values in found.items()}

    def frame(self, variable: str | None = None, frequency: str = "Hourly") -> Any:
        """A pandas DataFrame of output variables in the last environment of the run, from eplusout.sql, which a model
        with Output:SQLite writes. Columns are (variable, key), or keys if one variable is chosen; the index is the end
        of each interval in the site's standard time, with its time zone. `frequency`: "TimeStep", "Hourly", "Daily" or
        "Monthly"."""
        pandas_ = _needed("pandas", "frames")
        told = {"TimeStep": "Zone Timestep", "Hourly": "Hourly", "Daily": "Daily", "Monthly": "Monthly"}
        if frequency not in told:
            raise InvalidInput(f"frequency: {frequency!r}, expected one of {', '.join(told)}")
        rows = self._sql(
            """SELECT t.Year, t.Month, t.Day, t.Hour, t.Minute, d.Name, d.KeyValue, r.Value FROM ReportData r
               JOIN ReportDataDictionary d USING (ReportDataDictionaryIndex) JOIN Time t USING (TimeIndex)
               WHERE d.ReportingFrequency = ? AND (t.WarmupFlag IS NULL OR t.WarmupFlag = 0)
               AND t.EnvironmentPeriodIndex = (SELECT MAX(EnvironmentPeriodIndex) FROM Time)
               ORDER BY r.TimeIndex""", told[frequency])
        path = self.folder / "eplusout.sql"
        with reading(path, "a database of EnergyPlus's results"):
            rows = [row for row in rows if variable is None or row[5].upper() == variable.upper()]
        if not rows:
            raise InvalidInput(f"{variable or 'variables'}: none at {frequency} in {path}: "
                               "the model has no Output:Variable for it")
        zone = datetime.timezone(datetime.timedelta(hours=self._time_zone()))
        with reading(path, "a database of EnergyPlus's results"):
            times = [_time(row, zone) for row in rows]
        names = [row[6] if variable is not None else (row[5], row[6]) for row in rows]
        columns: dict[Any, list[int]] = {}
        for place, name in enumerate(names):
            columns.setdefault(name, []).append(place)
        table = pandas_.DataFrame({name: pandas_.Series([rows[i][7] for i in chosen], index=[times[i] for i in chosen])
                                   for name, chosen in columns.items()})
        if variable is None:
            table.columns = pandas_.MultiIndex.from_tuples(table.columns, names=["variable", "key"])
        table.index.name = "time"
        return table

    def light(self, by: str = "month") -> Any:
        """A pandas DataFrame of the light on each receiver, from the report of a run with `report`: "beam", "sky",
        "reflected by ground", "reflected by shades" and "all", by receiver and month in kWh/m2; or, with `by` "hour",
        by hour of each month's mean day too, in W/m2, without dark hours. All but the beam is NaN where only the beam
        is known."""
        pandas_ = _needed("pandas", "frames")
        tables = {"month": (_MONTHS, 2), "hour": ("run_mean_days.csv", 3)}
        if by not in tables:
            raise InvalidInput(f"by: {by!r}, expected month or hour")
        name, keys = tables[by]
        path = self.folder / _REPORT / name
        if not path.is_file():
            raise InvalidInput(f"{path}: no such file: the run needs report=True")
        with reading(path, "a table of a report"):
            table = pandas_.read_csv(path, index_col=list(range(keys)))
        return table.rename(columns=lambda head: head.partition(" [")[0])

    def summary(self) -> Summary:
        """Warnings, errors, time, variables, the site's energy if the tables are in eplusout.sql, light if there is a
        report, and errors of sunlit fractions."""
        end = _text(self.folder / "eplusout.end")
        counts = re.search(r"(\d+) Warning; *(\d+) Severe", end)
        spent = re.search(r"Elapsed Time=(\d+)hr *(\d+)min *(\d+\.?\d*)sec", end)
        hours, minutes, seconds = (float(part) for part in spent.groups()) if spent else (0.0, 0.0, float("nan"))
        return Summary(int(counts[1]) if counts else 0, int(counts[2]) if counts else 0,
                       3600 * hours + 60 * minutes + seconds, self.messages, self._variables(), self._site_energy(),
                       self._light(), shading_errors(self.folder))

    def _repr_html_(self) -> str:
        return self.summary()._repr_html_()

    def _light(self) -> dict[str, dict[str, float | None]]:
        found: dict[str, dict[str, float | None]] = {}
        path = self.folder / _REPORT / _MONTHS
        if not path.is_file():
            return found
        with reading(path, "a table of a report"):
            for row in rows_of(path):
                sums = found.setdefault(row.pop("receiver"), {})
                del row["month"]
                for head, text in row.items():
                    kind = head.partition(" [")[0]
                    sums[kind] = (sums.get(kind) or 0.0) + float(text) if text else None
        return found

    def _variables(self) -> tuple[str, ...]:
        found: dict[str, None] = {}
        path = self.folder / "eplusout.eso"
        if path.is_file():
            with open(path, encoding="utf-8", errors="replace") as lines:
                for line in lines:
                    if line.startswith("End of Data Dictionary"):
                        break
                    parts = line.partition(" !")[0].split(",")
                    if len(parts) >= 4:
                        found[parts[3].rpartition(" [")[0]] = None
        return tuple(found)

    def _site_energy(self) -> float | None:
        query = """SELECT Value, Units FROM TabularDataWithStrings WHERE TableName = 'Site and Source Energy'
                   AND RowName = 'Total Site Energy' AND ColumnName = 'Total Energy'"""
        try:
            [(value, units)] = self._sql(query)
            return float(value) / {"GJ": 0.0036, "kWh": 1.0, "MJ": 3.6}.get(units, float("nan"))
        except (InvalidInput, TypeError, ValueError):
            return None

    def _sql(self, query: str, *values: str) -> list[tuple[Any, ...]]:
        path = (self.folder / "eplusout.sql").absolute()
        if not path.is_file():
            raise InvalidInput(f"{path}: no such file: the model needs Output:SQLite")
        with contextlib.closing(sqlite3.connect(f"{path.as_uri()}?mode=ro", uri=True)) as data:
            try:
                return data.execute(query, values).fetchall()
            except sqlite3.DatabaseError as error:
                raise InvalidInput(f"{path}: {error}") from None

    def _time_zone(self) -> float:
        """Hours ahead of universal time, from eplusout.eio."""
        found = re.search(r"^ *Site:Location *,[^,\n]*,[^,\n]*,[^,\n]*,([^,\n]*)",
                          _text(self.folder / "eplusout.eio"), re.MULTILINE)
        if not found:
            raise InvalidInput(f"{self.folder / 'eplusout.eio'}: has no Site:Location")
        with reading(self.folder / "eplusout.eio", "a file of EnergyPlus's"):
            return number(float(found[1]), "time zone", -12.0, 14.0)


def shading_errors(folder: Path) -> ShadingErrors | None:
    """As eplusout.eio in a run's output folder states them, if it does."""
    path = folder / "eplusout.eio"
    found = re.search(r"^GPU Shading Error,(.*)$", _text(path), re.MULTILINE)
    if not found:
        return None
    with reading(path, "a file of EnergyPlus's"):
        target, sampled, within, largest, exact, not_measured = found[1].split(",")
        return ShadingErrors(float(target) if target else None, int(sampled), float(within) if within else None,
                             float(largest) if largest else None, int(exact), int(not_measured))


def _needed(module: str, what: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError:
        raise ImportError(f"{what} need {module}: pip install {module}") from None


def _time(row: tuple[Any, ...], zone: datetime.tzinfo) -> datetime.datetime:
    """The end of an interval, from year, month, day, hour and minute; 24:00 is midnight of the next day."""
    year, month, day, hour, minute = row[:5]
    begin = datetime.datetime(year or 2017, month or 1, day or 1, tzinfo=zone)
    return begin + datetime.timedelta(hours=hour or 0, minutes=minute or 0)


def run(model: _programs.Name, weather: _programs.Name, folder: _programs.Name | None = None, *,
        shading: bool = True, error: float | None = None, resolution: int | None = None, update: str | None = None,
        device: str | None = None, extensions: _programs.Name | None = None, threads: int | None = None,
        sky: str | None = None, reflections: str | None = None, pv: Sequence[Power] | None = None,
        report: bool = False, arguments: Sequence[str] = ()) -> Run:
    """Runs `energyplus --gpu-shading` on an IDF or epJSON file with an EPW file.

    `folder`: the output folder, new or empty; if None, a new one among the temporary files. `shading`: False for
    EnergyPlus's own polygon clipping. Options of the renderer, as the flags `--gpu-shading-error` and so on: `error` or
    `resolution`, `update`, `device`, a side file of `extensions`, the number of `threads`, `sky`, and `reflections`.
    `pv`: the power() of modules, whose loss by partly shaded cells is taken from the sunlit fractions of their
    surfaces, so that EnergyPlus's generators have it. `report`: writes the run's page and tables into the folder's
    folder "report", for Run.light(). `arguments`: more for EnergyPlus, such as ["-D"]. A run that does not complete
    raises RunError with EnergyPlus's reason.
    """
    program = _programs.prefix() / "energyplus"
    flags = ["--gpu-shading" if shading else "--gpu-shading=off"]
    for name, value in (("error", error), ("resolution", resolution), ("update", update), ("device", device),
                        ("file", None if extensions is None else _programs.file(extensions, "extensions")),
                        ("threads", threads), ("sky", sky), ("reflections", reflections)):
        if value is not None:
            flags.append(f"--gpu-shading-{name}={value}")
    inputs = [_programs.file(weather, "weather"), _programs.file(model, "model")]
    out = empty_folder(folder)
    if pv is not None:
        write_reductions(pv, out / "pv_reductions.csv")
        flags.append(f"--gpu-shading-pv={out / 'pv_reductions.csv'}")
    if report:
        flags.append(f"--gpu-shading-report={out / _REPORT}")
    command: list[str | Path] = [program, *flags, *arguments, "-w", inputs[0], "-d", out, inputs[1]]
    # A session of its own, so that helpers of EnergyPlus end with it.
    with subprocess.Popen(command, cwd=out, env=_programs.environment(), stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True) as process:
        try:
            errors = process.communicate()[1].decode(errors="replace")
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    if process.returncode != 0 or "Completed Successfully" not in _text(out / "eplusout.end"):
        raise RunError(_reason(errors, out, process.returncode))
    own = (line.partition("gpu_shading: ")[2] for line in errors.splitlines() if "gpu_shading: " in line)
    return Run(out, tuple(own))


def empty_folder(folder: _programs.Name | None) -> Path:
    """A new or empty folder, made where there is none; a temporary one for None."""
    if folder is None:
        return Path(tempfile.mkdtemp(prefix="gpu_shading_run_"))
    path = _programs.folder(folder, Path())
    try:
        path.mkdir(parents=True, exist_ok=True)
        if any(path.iterdir()):
            raise InvalidInput(f"folder: {path} is not empty")
    except OSError as error:
        raise InvalidInput(f"folder: {path}: {error.strerror}") from None
    return path


def _entry(line: str, variable: str, frequency: str | None) -> tuple[str, str]:
    """(number, key) of a line of the dictionary that is about the variable, such as
    "53,1,WINDOW,Surface Outside Face Sunlit Fraction [] !Hourly"."""
    front, _, told = line.strip().partition(" !")
    parts = front.split(",")
    if len(parts) < 4 or parts[3].rpartition(" [")[0] != variable:
        return "", ""
    if frequency is not None and told.split("[")[0].strip() != frequency:
        return "", ""
    return parts[0], parts[2]


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""


def _reason(errors: str, folder: Path, status: int) -> str:
    """Why a run failed, in one line."""
    if "gpu_shading: error: " in errors:
        return _programs.last_message(errors, "energyplus", status)
    for line in _text(folder / "eplusout.err").splitlines():
        for kind in ("** Severe  **", "**  Fatal  **"):
            if kind in line:
                return f"EnergyPlus: {line.partition(kind)[2].strip()} ({folder / 'eplusout.err'})"
    return _programs.last_message(errors, "energyplus", status)
