"""Plans of studies: models x variants x weather files, from TOML, CSV or Python."""

from __future__ import annotations

import csv
import importlib
import io
import math
import os
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from gpu_shading import _programs
from gpu_shading._text import escaped, quoted
from gpu_shading.errors import InvalidInput
from gpu_shading.study import inputs
from gpu_shading.study.find_models import find_models

OPTIONS = ("error", "resolution", "update", "device", "threads", "sky", "reflections", "surroundings", "lean", "method",
           "assets", "cache", "cache-size", "cache-read-only")
LARGEST = {"shards": 1000, "limit": 1e7, "tries": 100, "workers": 10_000}
MAX_RUNS = 1_000_000
_JOBQUEUES = ("slurm", "pbs", "lsf")
_MAX_TOML = 4 * inputs.MEBIBYTE
_STRINGS = re.compile(r'"""(?:\\.|[^\\])*?"""|' r"'''.*?'''|" r'"(?:\\.|[^"\\\n])*"|' r"'[^'\n]*'|#[^\n]*", re.DOTALL)
_DEEP_KEY = re.compile(r"(?<![\w-])(?:[\w-]+[ \t]*\.[ \t]*){20}")


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
            raise InvalidInput(f"{file}: {place}: {quoted(values)}, expected a table")
        self.values = dict(values)

    def refuse(self, key: str, value: Any, expected: str) -> InvalidInput:
        name = f"{self.place}.{key}" if self.place else key
        return InvalidInput(f"{self.file}: {escaped(name)}: {quoted(value)}, expected {expected}")

    def take(self, key: str, expected: str, is_right: Callable[[Any], bool], default: Any) -> Any:
        value = self.values.pop(key, default)
        if value is not default and not is_right(value):
            raise self.refuse(key, value, expected)
        return value

    def text(self, key: str, default: str | None = "") -> Any:
        return self.take(key, "text in one line", _is_line, default)

    def texts(self, key: str) -> list[str]:
        value = self.take(key, "text in one line, or a list of such texts", lambda value: _is_line(value) or (
            isinstance(value, list) and all(map(_is_line, value))), [])
        return [value] if isinstance(value, str) else list(value)

    def table(self, key: str) -> dict[str, Any]:
        return dict(self.take(key, "a table", lambda value: isinstance(value, dict), {}))

    def number(self, key: str, whole: bool = True) -> Any:
        """From 1 to the largest."""
        return self.take(key, f"a {'whole ' if whole else ''}number of at least 1 and at most {LARGEST[key]:g}",
                         lambda value: is_number(value, 1, LARGEST[key], whole), None)

    def options(self) -> dict[str, Any]:
        options = self.table("options")
        for name, value in options.items():
            if name not in OPTIONS:
                raise self.refuse(f"options.{name}", value, f"one of the options {', '.join(OPTIONS)}")
            if not is_value(value):
                raise self.refuse(f"options.{name}", value, "a finite number, or text in one line")
        return options

    def done(self, known: str) -> None:
        for key, value in self.values.items():
            raise self.refuse(key, value, f"no such key, but {known}")


def _is_line(value: Any) -> bool:
    return isinstance(value, str) and escaped(value) == value


def is_number(value: Any, least: float, largest: float, whole: bool) -> bool:
    return isinstance(value, int if whole else (int, float)) and not isinstance(value, bool) and (
        least <= value <= largest)


def is_value(value: Any) -> bool:
    """Of an option or a field."""
    return _is_line(value) or (isinstance(value, float) and math.isfinite(value)) or (
        isinstance(value, int) and not isinstance(value, bool) and abs(value) < 10**18)


def read_plan(file: _programs.Name) -> Plan:
    """Raises InvalidInput, with one line that names the file, the key, the value, and what was expected."""
    path = Path(file)
    if not os.path.lexists(path):
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
        text = inputs.read(path, _MAX_TOML).decode()
        if _DEEP_KEY.search(_STRINGS.sub("s", text)):  # tomllib takes a minute for one of 60 kB
            raise RecursionError
        content = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InvalidInput(f"{path}: is not TOML: {error}") from None
    except (RecursionError, ValueError) as error:
        if isinstance(error, InvalidInput):
            raise
        # Numbers of thousands of digits, dates that do not exist.
        why = "is nested too deeply" if isinstance(error, RecursionError) else f"is not TOML: {error}"
        raise InvalidInput(f"{path}: {why}") from None
    top = _Table(path, "", content)
    models = [model for pattern in top.texts("models") for model in _models(top, path, "models", pattern)]
    if not models:
        raise InvalidInput(f"{path}: models: missing, expected files, folders or patterns")
    weathers = [_weather(top, path, name) for name in top.texts("weather")]
    if not weathers:
        raise InvalidInput(f"{path}: weather: missing, expected weather files")
    common, arguments = top.options(), tuple(top.texts("arguments"))
    settings = {key: value for key, value in {
        "task": top.text("task"), "mode": top.text("mode"), "shards": top.number("shards"),
        "outputs": tuple(top.texts("outputs")), "keep": tuple(top.texts("keep")), "limit": top.number("limit", False),
        "tries": top.number("tries"), "jobqueue": top.table("jobqueue")}.items() if value not in (None, "", (), {})}
    written = top.take("variant", "tables [[variant]]", lambda value: isinstance(value, list), [{}])
    top.done("models, weather, task, mode, shards, options, arguments, outputs, keep, limit, tries, jobqueue, variant")
    if len(models) * len(written) * len(weathers) > MAX_RUNS:
        raise InvalidInput(f"{path}: {len(models)} models, {len(written)} variants and {len(weathers)} weather files; "
                           f"expected at most {MAX_RUNS:,} runs: make several plans")
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
    objects = table.take("objects", "an IDF file, or IDF text", lambda value: isinstance(value, str), "")
    if objects and ";" not in objects:
        file = path.parent / objects
        if not inputs.is_file(file):
            raise table.refuse("objects", objects, "an IDF file, or IDF text")
        try:
            objects = inputs.read(file, inputs.MAX_MODEL).decode(errors="surrogateescape")
        except InvalidInput as error:
            raise InvalidInput(f"{path}: {place}.objects: {error}") from None
    case = Case("", "", name, None if extensions is None else path.parent / extensions,
                {**common, **table.options()}, table.table("set"), tuple(table.texts("remove")), objects,
                arguments + tuple(table.texts("arguments")))
    table.done("name, extensions, options, set, remove, objects, arguments")
    if extensions is not None and not inputs.is_file(Path(str(case.extensions))):
        raise table.refuse("extensions", extensions, "a file")
    return case


def _models(table: _Table, plan: Path, key: str, name: str) -> list[Path]:
    """Of a folder, all models in it and below."""
    try:
        found = find_models(plan.parent, name) if name else []
    except InvalidInput as error:
        raise InvalidInput(f"{plan}: {key}: {error}") from None
    if not found:
        raise table.refuse(key, name, "files or folders with models (IDF or epJSON)")
    return found


def _weather(table: _Table, plan: Path, name: str) -> Path:
    for folder in (plan.parent, _programs.prefix() / "WeatherData"):
        if inputs.is_file(folder / name):
            return folder / name
    raise table.refuse("weather", name, "a weather file (EPW)")


def _read_csv(path: Path) -> Plan:
    """A row for each run: model, weather, variant, extensions, option:NAME, set:Class/Name/Field."""
    with inputs.opened(path, inputs.MAX_TABLE) as file:
        rows = csv.DictReader(io.TextIOWrapper(file, encoding="utf-8-sig", newline=""))
        try:
            cases = tuple(_csv_cases(path, rows))
        except (csv.Error, UnicodeDecodeError) as error:
            raise InvalidInput(f"{path}: after line {rows.line_num}: is not CSV: {error}") from None
    return Plan(cases)


def _csv_cases(path: Path, rows: csv.DictReader[str]) -> Iterator[Case]:
    names = list(rows.fieldnames or [])
    for name in names:
        known = name in ("model", "weather", "variant", "extensions", "arguments") or (
            name.startswith("option:") and name[7:] in OPTIONS) or name.startswith("set:")
        if not known:
            raise InvalidInput(f"{path}: column {quoted(name)}: expected model, weather, variant, extensions, "
                               "arguments, option:NAME or set:Class/Object Name/Field")
        if names.count(name) > 1:
            raise InvalidInput(f"{path}: column {quoted(name)}: is there {names.count(name)} times; expected once")
    count = 0
    for row in rows:
        place = f"line {rows.line_num}"
        if None in row or None in row.values():
            raise InvalidInput(f"{path}: {place}: expected {len(names)} values")
        table = _Table(path, place, {key: value for key, value in row.items() if value})
        for key in names:
            table.text(key)
        table.values = {key: value for key, value in row.items() if value}
        models = _models(table, path, "model", table.text("model"))
        extensions = table.text("extensions", None)
        if extensions is not None and not inputs.is_file(path.parent / extensions):
            raise table.refuse("extensions", extensions, "a file")
        case = Case("", _weather(table, path, table.text("weather")), table.text("variant"),
                    None if extensions is None else path.parent / extensions,
                    {name[7:]: value for name, value in row.items() if name.startswith("option:") and value},
                    {name[4:]: value for name, value in row.items() if name.startswith("set:") and value},
                    arguments=tuple(table.text("arguments").split()))
        count += len(models)
        if count > MAX_RUNS:
            raise InvalidInput(f"{path}: {place}: expected at most {MAX_RUNS:,} runs: make several plans")
        yield from (replace(case, model=model) for model in models)


def check_jobqueue(kind: str) -> str:
    if kind not in _JOBQUEUES:
        raise InvalidInput(f"--jobqueue {escaped(kind)}: expected one of {', '.join(_JOBQUEUES)}")
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
