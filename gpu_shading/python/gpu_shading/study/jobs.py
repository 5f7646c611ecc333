"""The jobs of a study: its cases with names, resolved fields, and digests of all inputs."""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Sequence
from functools import cache, lru_cache
from pathlib import Path

from gpu_shading import _programs
from gpu_shading._library import __version__
from gpu_shading.errors import InvalidInput
from gpu_shading.study import models, tasks
from gpu_shading.study.plan import OPTIONS, Case, model_names
from gpu_shading.study.tasks import digest


def make_jobs(cases: Sequence[Case], source: str, folder: Path, outputs: tuple[str, ...], keep: tuple[str, ...],
          limit: float | None, task: list[str]) -> list[tasks.Job]:
    names, jobs = model_names(case.model for case in cases), []
    for known in (_contents, _files, _digest_of):
        known.cache_clear()  # files may have changed since the last study
    versions = f"{__version__} {energyplus_version()}"
    for case in cases:
        model = _programs.file(case.model, f"{source}: model")
        weather = _programs.file(case.weather, f"{source}: weather")
        extensions = None if case.extensions is None else _programs.file(case.extensions, f"{source}: extensions")
        name = "/".join(filter(None, (names[Path(os.path.abspath(case.model))], case.variant, weather.stem)))
        for option in case.options:
            if option not in OPTIONS:
                raise InvalidInput(f"{source}: {name}: option {option!r}, expected one of {', '.join(OPTIONS)}")
        try:
            fields = tuple((_located(text), str(value)) for text, value in case.fields.items())
            remove = tuple(_pair(text) for text in case.remove)
            for words, (type_, pattern) in [*((place.words, (place.type, place.pattern)) for place, _ in fields),
                                            *zip(case.remove, remove, strict=True)]:
                if not _contents(model).count(type_, pattern):
                    raise InvalidInput(f"{words!r}: {model} has no such object")
        except InvalidInput as error:
            raise InvalidInput(f"{source}: {name}: {error}") from None
        side_file = extensions or model.with_suffix(".gpu-shading.idf")
        options = {key: os.path.abspath(value) if key == "cache" else str(value)
                   for key, value in case.options.items()}
        scene_id = digest([
            versions, _digest_of(model), _digest_of(side_file),
            [_digest_of(model.parent / file) for file in _files(model, model.parent) + _files(side_file, model.parent)],
            sorted(options.items()), sorted((key, str(value)) for key, value in case.fields.items()),
            list(case.remove), case.objects])
        inputs = digest([scene_id, _digest_of(weather), list(case.arguments), list(outputs), *task])
        readable = re.sub(r"[^\w.-]+", "-", name)[:80]
        jobs.append(tasks.Job(
            name, case.variant, f"{readable}-{inputs}", str(model), str(weather),
            None if extensions is None else str(extensions), options, fields, remove, case.objects, case.arguments,
            outputs, keep, limit, str(folder), scene_id))
    seen: set[str] = set()
    for job in jobs:
        if job.name in seen:
            raise InvalidInput(f"{source}: {job.name}: two runs have this model, variant and weather; expected another "
                               "name of the variant")
        seen.add(job.name)
    return jobs


@lru_cache(maxsize=4096)
def _located(text: str) -> models.Field:
    return models.find_field(text)


@lru_cache(maxsize=1)
def _contents(model: Path) -> models.Idf | models.EpJson:
    return models.read(model)


@cache
def _files(file: Path, folder: Path) -> list[str]:
    """What a model or its side file names, relative to the model's folder."""
    return models.read(file).files(folder) if file.is_file() else []


@cache
def _digest_of(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""


def _pair(text: str) -> tuple[str, str]:
    type_, _, pattern = text.partition("/")
    return type_, pattern or "*"


@lru_cache(maxsize=1)
def energyplus_version() -> str:
    marker = _programs.prefix() / ".gpu_shading_prefix.json"
    return str(json.loads(marker.read_bytes())["version"]) if marker.is_file() else ""
