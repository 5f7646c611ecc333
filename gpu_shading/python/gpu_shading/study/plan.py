"""Plans of studies: models x variants x weather files, from TOML, CSV or Python."""

from __future__ import annotations

import csv
import glob
import importlib
import os
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from gpu_shading import _programs
from gpu_shading.errors import InvalidInput

OPTIONS = ("error", "resolution", "update", "device", "threads", "lean", "method", "assets", "cache", "cache-size",
           "cache-read-only")
_JOBQUEUES = ("slurm", "pbs", "lsf")


@dataclass(frozen=True)
class Case:
    """One run of a study."""

    model: _programs.Name
    weather: _programs.Name
    variant: str = ""
    """Its name in the table."""
    extensions: _programs.Name | None = None
    """A side file of extension objects, in place of the model's."""
    options: Mapping[str, Any] = field(default_factory=dict)
    """Options of shading by the names of their flags, such as {"error": 0.01, "update": "timestep"}."""
    fields: Mapping[str, Any] = field(default_factory=dict)
    """Replaced values by "Class/Object Name/Field", as EnergyPlus's dictionary names them. Names may have * and ?."""
    remove: tuple[str, ...] = ()
    """Objects to leave out, as "Class/Object Name"."""
    objects: str = ""
    """Objects to add, as IDF text."""
    arguments: tuple[str, ...] = ()
    """More for EnergyPlus, such as ("-D",)."""


@dataclass(frozen=True)
class Plan:
    cases: tuple[Case, ...]
    settings: Mapping[str, Any] = field(default_factory=dict)
    """Arguments of Study."""


class _Table:
    """A table of a TOML file; errors name the file and the key."""

    def __init__(self, file: Path, place: str, values: Any) -> None:
        self.file, self.place = file, place
        if not isinstance(values, dict):
            raise InvalidInput(f"{file}: {place}: {values!r}, expected a table")
        self.values = dict(values)

    def refuse(self, key: str, value: Any, expected: str) -> InvalidInput:
        name = f"{self.place}.{key}" if self.place else key
        return InvalidInput(f"{self.file}: {name}: {value!r}, expected {expected}")

    def take(self, key: str, expected: str, is_right: Callable[[Any], bool], default: Any) -> Any:
        value = self.values.pop(key, default)
        if value is not default and not is_right(value):
            raise self.refuse(key, value, expected)
        return value

    def text(self, key: str, default: str | None = "") -> Any:
        return self.take(key, "text", lambda value: isinstance(value, str), default)

    def texts(self, key: str) -> list[str]:
        value = self.take(key, "text or a list of texts", lambda value: isinstance(value, str) or (
            isinstance(value, list) and all(isinstance(item, str) for item in value)), [])
        return [value] if isinstance(value, str) else list(value)

    def table(self, key: str) -> dict[str, Any]:
        return dict(self.take(key, "a table", lambda value: isinstance(value, dict), {}))

    def number(self, key: str, least: float) -> Any:
        return self.take(key, f"a number of at least {least:g}", lambda value: isinstance(value, (int, float)) and
                         not isinstance(value, bool) and value >= least, None)

    def options(self) -> dict[str, Any]:
        options = self.table("options")
        for name, value in options.items():
            if name not in OPTIONS:
                raise self.refuse(f"options.{name}", value, f"one of the options {', '.join(OPTIONS)}")
        return options

    def done(self, known: str) -> None:
        for key, value in self.values.items():
            raise self.refuse(key, value, f"no such key, but {known}")


def read_plan(file: _programs.Name) -> Plan:
    """Raises InvalidInput, with one line that names the file, the key, the value, and what was expected."""
    path = Path(file)
    if not path.is_file():
        raise InvalidInput(f"{path}: no such file; expected a plan in TOML or CSV")
    readers = {".toml": _read_toml, ".csv": _read_csv}
    if path.suffix.lower() not in readers:
        raise InvalidInput(f"{path}: expected a name that ends in .toml or .csv")
    plan = readers[path.suffix.lower()](path)
    if not plan.cases:
        raise InvalidInput(f"{path}: has no runs; expected at least one")
    return plan


def _read_toml(path: Path) -> Plan:
    try:
        tomllib = importlib.import_module("tomllib")
    except ImportError:  # Python 3.10
        tomllib = importlib.import_module("tomli")
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InvalidInput(f"{path}: is not TOML: {error}") from None
    top = _Table(path, "", content)
    models = [model for pattern in top.texts("models") for model in _models(top, path, pattern)]
    if not models:
        raise InvalidInput(f"{path}: models: missing, expected files, folders or patterns")
    weathers = [_weather(top, path, name) for name in top.texts("weather")]
    if not weathers:
        raise InvalidInput(f"{path}: weather: missing, expected weather files")
    common, arguments = top.options(), tuple(top.texts("arguments"))
    settings = {key: value for key, value in {
        "task": top.text("task"), "mode": top.text("mode"), "shards": top.number("shards", 1),
        "outputs": tuple(top.texts("outputs")), "keep": tuple(top.texts("keep")), "limit": top.number("limit", 1),
        "tries": top.number("tries", 1), "jobqueue": top.table("jobqueue")}.items() if value not in (None, "", (), {})}
    written = top.take("variant", "tables [[variant]]", lambda value: isinstance(value, list), [{}])
    top.done("models, weather, task, mode, shards, options, arguments, outputs, keep, limit, tries, jobqueue, variant")
    variants = [_variant(path, f"variant {number}", values, common, arguments, len(written) > 1)
                for number, values in enumerate(written, 1)]
    return Plan(tuple(replace(variant, model=model, weather=weather)
                      for model in models for variant in variants for weather in weathers), settings)


def _variant(path: Path, place: str, values: Any, common: dict[str, Any], arguments: tuple[str, ...],
             named: bool) -> Case:
    table = _Table(path, place, values)
    name = table.text("name")
    if named and not name:
        raise InvalidInput(f"{path}: {place}.name: missing, expected a name that no other variant has")
    extensions = table.text("extensions", None)
    objects = table.text("objects")
    if objects and ";" not in objects:
        file = path.parent / objects
        if not file.is_file():
            raise table.refuse("objects", objects, "an IDF file, or IDF text")
        objects = file.read_text(encoding="utf-8", errors="surrogateescape")
    case = Case("", "", name, None if extensions is None else path.parent / extensions,
                {**common, **table.options()}, table.table("set"), tuple(table.texts("remove")), objects,
                arguments + tuple(table.texts("arguments")))
    table.done("name, extensions, options, set, remove, objects, arguments")
    if extensions is not None and not Path(str(case.extensions)).is_file():
        raise table.refuse("extensions", extensions, "a file")
    return case


def _models(table: _Table, plan: Path, pattern: str) -> list[Path]:
    """Of a folder, all models in it and below."""
    path = plan.parent / pattern
    found = [path] if path.is_file() else []
    if not found:
        patterns = [f"{glob.escape(str(path))}/**/*"] if path.is_dir() else [str(path)]
        found = sorted(Path(name) for each in patterns for name in glob.glob(each, recursive=True)
                       if name.lower().endswith((".idf", ".epjson")) and not name.lower().endswith(".gpu-shading.idf"))
    if not found:
        raise table.refuse("models", pattern, "files or folders with models (IDF or epJSON)")
    return found


def _weather(table: _Table, plan: Path, name: str) -> Path:
    for folder in (plan.parent, _programs.prefix() / "WeatherData"):
        if (folder / name).is_file():
            return folder / name
    raise table.refuse("weather", name, "a weather file (EPW)")


def _read_csv(path: Path) -> Plan:
    """A row for each run: model, weather, variant, extensions, option:NAME, set:Class/Name/Field."""
    cases = []
    with open(path, newline="", encoding="utf-8-sig") as lines:
        rows = csv.DictReader(lines)
        for name in rows.fieldnames or []:
            known = name in ("model", "weather", "variant", "extensions", "arguments") or (
                name.startswith("option:") and name[7:] in OPTIONS) or name.startswith("set:")
            if not known:
                raise InvalidInput(f"{path}: column {name!r}: expected model, weather, variant, extensions, arguments, "
                                   "option:NAME or set:Class/Object Name/Field")
        for row in rows:
            place = f"line {rows.line_num}"
            if None in row or None in row.values():
                raise InvalidInput(f"{path}: {place}: expected {len(rows.fieldnames or [])} values")
            table = _Table(path, place, {key: value for key, value in row.items() if value})
            models = _models(table, path, table.text("model"))
            extensions = table.text("extensions", None)
            if extensions is not None and not (path.parent / extensions).is_file():
                raise table.refuse("extensions", extensions, "a file")
            case = Case("", _weather(table, path, table.text("weather")), table.text("variant"),
                        None if extensions is None else path.parent / extensions,
                        {name[7:]: value for name, value in row.items() if name.startswith("option:") and value},
                        {name[4:]: value for name, value in row.items() if name.startswith("set:") and value},
                        arguments=tuple(table.text("arguments").split()))
            cases += [replace(case, model=model) for model in models]
    return Plan(tuple(cases))


def check_jobqueue(kind: str) -> str:
    if kind not in _JOBQUEUES:
        raise InvalidInput(f"--jobqueue {kind}: expected one of {', '.join(_JOBQUEUES)}")
    return kind


def model_names(models: Iterable[_programs.Name]) -> dict[Path, str]:
    """A short name for each: the file's without its extension, with as many folders as tell it from the others."""
    paths = list(dict.fromkeys(Path(os.path.abspath(model)) for model in models))
    bare = Counter(path.with_suffix("") for path in paths)
    # An IDF and an epJSON may have all else in common.
    last = {path: path.name if bare[path.with_suffix("")] > 1 else path.stem for path in paths}
    names: dict[Path, str] = {}
    left, length = paths, 1
    while left:
        trial = {path: "/".join([*path.parts[-length:-1], last[path]]) for path in left}
        times = Counter(trial.values())
        names |= {path: name for path, name in trial.items() if times[name] == 1}
        left, length = [path for path in left if path not in names], length + 1
    return names
