"""The jobs of a study: its cases with names, resolved fields, and digests of all inputs."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Sequence
from functools import cache, lru_cache
from pathlib import Path

from gpu_shading import _programs
from gpu_shading._library import __version__
from gpu_shading._text import escaped, quoted
from gpu_shading.errors import InvalidInput
from gpu_shading.study import inputs, models, tasks
from gpu_shading.study.plan import OPTIONS, Case, is_value, model_names
from gpu_shading.study.tasks import digest

_DECIDED = ("-d", "-p", "-s", "-w", "--output-", "--weather")  # flags of EnergyPlus


def make_jobs(cases: Sequence[Case], source: str, folder: Path, outputs: tuple[str, ...], keep: tuple[str, ...],
          limit: float | None, task: list[str]) -> list[tasks.Job]:
    names, jobs = model_names(case.model for case in cases), []
    for known in (_contents, _files, _digest_of):
        known.cache_clear()  # files may have changed since the last study
    versions = f"{__version__} {energyplus_version()}"
    for case in cases:
        model = _file(case.model, f"{source}: model")
        weather = _file(case.weather, f"{source}: weather")
        extensions = None if case.extensions is None else _file(case.extensions, f"{source}: extensions")
        name = "/".join(filter(None, (names[Path(os.path.abspath(case.model))], case.variant, weather.stem)))
        options = {key: os.path.abspath(str(value)) if key == "cache" else str(value)
                   for key, value in case.options.items()}
        try:
            fields, remove = _changes(case, model)
            scene_id = digest([versions, _digests(model, extensions), sorted(options.items()),
                               sorted((key, str(value)) for key, value in case.fields.items()), list(case.remove),
                               case.objects])
            run_id = digest([scene_id, _digest_of(weather), list(case.arguments), list(outputs), *task])
        except InvalidInput as error:
            raise InvalidInput(f"{source}: {name}: {error}") from None
        # A name of a file has at most 255 bytes.
        readable = re.sub(r"[^\w.-]+", "-", name).encode(errors="ignore")[:80].decode(errors="ignore")
        jobs.append(tasks.Job(
            name, case.variant, f"{readable}-{run_id}", str(model), str(weather),
            None if extensions is None else str(extensions), options, fields, remove, case.objects, case.arguments,
            outputs, keep, limit, str(folder), scene_id))
    seen: set[str] = set()
    for job in jobs:
        if job.name in seen:
            raise InvalidInput(f"{source}: {job.name}: two runs have this model, variant and weather; expected another "
                               "name of the variant")
        seen.add(job.name)
    return jobs


def _digests(model: Path, extensions: Path | None) -> list[list[str]]:
    """Those of the model and its side file, and those of the files that they name."""
    side_file = inputs.side_file(extensions or model.with_suffix(".gpu-shading.idf"))
    files = [model] if side_file is None else [model, side_file]
    return [[_digest_of(file) for file in files],
            [_digest_of(model.parent / name) for file in files for name in _files(file, model.parent)]]


@lru_cache(maxsize=4096)
def _located(text: str) -> models.Field:
    return models.find_field(text)


@lru_cache(maxsize=1)
def _contents(model: Path) -> models.Idf | models.EpJson:
    return models.read(model)


@cache
def _files(file: Path, folder: Path) -> list[str]:
    """What a model or its side file names, relative to the model's folder."""
    return models.read(file).files(folder)


@cache
def _digest_of(file: Path) -> str:
    return inputs.digest_of(file)


def _file(name: _programs.Name, what: str) -> Path:
    path = Path(name)
    if not inputs.is_file(path):
        raise InvalidInput(f"{what}: {path}: no such file")
    return path.absolute()


def _changes(case: Case, model: Path) -> tuple[tuple[tuple[models.Field, str], ...], tuple[tuple[str, str], ...]]:
    """Fields with their values, and what to remove. Raises InvalidInput if the case cannot be applied to the model."""
    for option, value in case.options.items():
        if option not in OPTIONS:
            raise InvalidInput(f"option {quoted(option)}, expected one of {', '.join(OPTIONS)}")
        if not is_value(value):
            raise InvalidInput(f"option {option}: {quoted(value)}, expected a finite number, or text in one line")
    for text in (case.variant, *case.arguments, *case.fields, *case.remove):
        if escaped(text) != text:
            raise InvalidInput(f"{quoted(text)} has control characters")
    for word in case.arguments:
        if word.startswith(_DECIDED):
            raise InvalidInput(f"arguments: {quoted(word)}: a study decides where weather and results are; expected "
                               "other flags of EnergyPlus")
    for text, value in case.fields.items():
        if not is_value(value):
            raise InvalidInput(f"{quoted(text)}: {quoted(value)}, expected a finite number, or text in one line")
    fields = tuple((_located(text), str(value)) for text, value in case.fields.items())
    remove = tuple(_pair(text) for text in case.remove)
    is_idf = model.suffix.lower() != ".epjson"
    held: dict[tuple[str, str], int] = {}
    for place, value in fields:
        _require(f"{place.type}/{place.pattern}", model, place.type, place.pattern)
        place.check(value, is_idf)
        if place.item is not None:
            # Fields that were set before may have made the list longer.
            items = max(held.get((place.type, place.pattern), 0), _contents(model).items(place))
            if place.item > items:
                raise InvalidInput(f"{quoted(place.text)}: {place.type} has {items} of these; expected at most number "
                                   f"{items + 1}")
            held[place.type, place.pattern] = max(items, place.item + 1)
    for text, (type_, pattern) in zip(case.remove, remove, strict=True):
        _require(text, model, type_, pattern)
    if case.objects:
        if not is_idf:
            raise InvalidInput("objects: can be added to an IDF, not to epJSON")
        models.check_objects(case.objects)
    return fields, remove


def _require(text: str, model: Path, type_: str, pattern: str) -> None:
    if not _contents(model).count(type_, pattern):
        raise InvalidInput(f"{quoted(text)}: {model} has no such object")


def _pair(text: str) -> tuple[str, str]:
    type_, _, pattern = text.partition("/")
    return type_, pattern or "*"


@lru_cache(maxsize=1)
def energyplus_version() -> str:
    marker = _programs.prefix() / ".gpu_shading_prefix.json"
    return str(json.loads(marker.read_bytes())["version"]) if marker.is_file() else ""
