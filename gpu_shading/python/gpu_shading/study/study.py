"""A study: its runs in order, which of them share shading, and what is there already."""

from __future__ import annotations

import contextlib
import csv
import fcntl
import hashlib
import json
import os
import re
import shutil
import tempfile
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, lru_cache, partial
from pathlib import Path
from typing import Any

from gpu_shading import _programs
from gpu_shading._library import __version__
from gpu_shading.errors import InvalidInput, RunError
from gpu_shading.study import models, tasks
from gpu_shading.study.engine import Engine, open_client
from gpu_shading.study.plan import Case, model_names, read_plan
from gpu_shading.study.progress import Progress, in_words, say
from gpu_shading.study.table import write_tables

_WRITE_SHARE = 20  # the time between two tables is so many times that of writing one


class Study:
    """Runs of EnergyPlus, from a plan (a TOML or CSV file) or from Cases of any iterable.

    `folder`: where the table and what is kept go. A study that is run again with the same folder does what is missing.
    `workers`: processes on this machine, as many as cores if None; or the address of a Dask `scheduler`; or a
    `jobqueue`: {"kind": "slurm", "workers": 20, and arguments of dask-jobqueue's cluster}. `outputs`: output variables
    for the table, over the run period. `keep`: "tables", "sql", "all" or "nothing" of each run. `limit`: seconds, after
    which a run is stopped. `tries`: how often a run that fails is tried.
    """

    def __init__(self, plan: _programs.Name | Iterable[Case], folder: _programs.Name, *, workers: int | None = None,
                 scheduler: str | None = None, jobqueue: Mapping[str, Any] | None = None,
                 outputs: Sequence[str] | None = None, keep: Sequence[str] | None = None, limit: float | None = None,
                 tries: int | None = None) -> None:
        self.folder = Path(folder).absolute()
        given: Mapping[str, Any] = {}
        source = "study"
        if isinstance(plan, (str, os.PathLike)):
            read = read_plan(plan)
            cases, given, source = list(read.cases), read.settings, str(plan)
        else:
            cases = list(plan)
        self.workers, self.scheduler = workers, scheduler
        self.jobqueue: dict[str, Any] = {**given.get("jobqueue", {}), **(jobqueue or {})}
        if not jobqueue and "kind" not in self.jobqueue:
            self.jobqueue = {}
        self.tries = int(tries or given.get("tries", 2))
        kept = (keep,) if isinstance(keep, str) else tuple(keep or given.get("keep", ("tables",)))
        for kind in kept:
            if kind not in tasks.KEEP:
                raise InvalidInput(f"{source}: keep: {kind!r}, expected one of {', '.join(tasks.KEEP)}")
        self.jobs = _jobs(cases, source, self.folder, tuple(outputs or given.get("outputs", ())), kept,
                          limit or given.get("limit"))

    def run(self) -> list[dict[str, Any]]:
        """Runs what is missing, and returns the rows of the table in the order of the plan. Those of runs that failed
        have the status "failed", and a message."""
        with _only_one(self.folder):
            done = _Results(self.folder, self.jobs)
            if done.missing():
                with self._client() as client:
                    _Schedule(self.jobs, self.folder, done, Engine(client, self.tries)).run()
            done.write()
            return done.rows()

    def dry_run(self) -> str:
        """How many runs and distinct scenes there are, and about how long the runs will take."""
        with _only_one(self.folder), self._client() as client:
            done, engine, scenes = _Results(self.folder, self.jobs), Engine(client, 1), dict[str, str]()
            errors: list[str] = []

            def note(job: tasks.Job, outcome: tasks.Outcome, _: int) -> None:
                if outcome.error:
                    errors.append(f"{job.name}: {outcome.error}")
                else:
                    scenes[job.scene_id] = outcome.values["scene"]

            for job in {job.scene_id: job for job in self.jobs}.values():
                engine.submit(tasks.scene_of, job, then=partial(note, job))
            engine.run()
            workers = max(len(client.scheduler_info(n_workers=-1)["workers"]), 1)
        missing = done.missing()
        lines = [f"{len(self.jobs)} runs, {len(self.jobs) - len(missing)} of them done, with "
                 f"{len(set(scenes.values()))} distinct scenes"]
        if missing:
            seconds, origin = done.mean_seconds(), "the runs that are done"
            if seconds is None:
                seconds, origin = _time_one(missing[0]), f"one run of {missing[0].name}"
            lines.append(f"about {in_words(seconds * len(missing) / workers)} on {workers} workers, by {origin} "
                         f"({seconds:.1f} s)")
        return "\n".join([*lines, *errors])

    @contextlib.contextmanager
    def _client(self) -> Any:
        client = open_client(self.workers, self.scheduler, self.jobqueue, self.tries)
        try:
            say(f"workers of {client.scheduler.address}; dashboard {client.dashboard_link}")
            yield client
        finally:
            cluster = client.cluster
            client.close()
            if cluster is not None:
                cluster.close()


@contextlib.contextmanager
def _only_one(folder: Path) -> Any:
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / ".lock", "w", encoding="ascii") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise RunError(f"{folder}: another study is running in this folder") from None
        # What killed workers have left; those that still run lose their folder, and end.
        shutil.rmtree(folder / "work", ignore_errors=True)
        try:
            yield
        finally:
            shutil.rmtree(folder / "work", ignore_errors=True)


def _jobs(cases: Sequence[Case], source: str, folder: Path, outputs: tuple[str, ...], keep: tuple[str, ...],
          limit: float | None) -> list[tasks.Job]:
    names, jobs = model_names(case.model for case in cases), []
    for known in (_contents, _files, _digest_of):
        known.cache_clear()  # files may have changed since the last study
    versions = f"{__version__} {_energyplus_version()}"
    for case in cases:
        model = _programs.file(case.model, f"{source}: model")
        weather = _programs.file(case.weather, f"{source}: weather")
        extensions = None if case.extensions is None else _programs.file(case.extensions, f"{source}: extensions")
        name = "/".join(filter(None, (names[Path(os.path.abspath(case.model))], case.variant, weather.stem)))
        try:
            fields = tuple((_located(text), str(value)) for text, value in case.fields.items())
            remove = tuple(_pair(text) for text in case.remove)
            for words, (type_, pattern) in [*((place.words, (place.type, place.pattern)) for place, _ in fields),
                                            *zip(case.remove, remove, strict=True)]:
                if not _contents(model).count(type_, pattern):
                    raise InvalidInput(f"{words!r}: {model} has no such object")
        except InvalidInput as error:
            raise InvalidInput(f"{source}: {name}: {error}") from None
        options = {key: str(value) for key, value in case.options.items()}
        scene_id = _digest([
            versions, _digest_of(model), _digest_of(extensions or model.with_suffix(".gpu-shading.idf")),
            [_digest_of(model.parent / file) for file in _files(model)], sorted(options.items()),
            sorted((key, str(value)) for key, value in case.fields.items()), list(case.remove), case.objects])
        digest = _digest([scene_id, _digest_of(weather), list(case.arguments), list(outputs)])
        readable = re.sub(r"[^\w.-]+", "-", name)[:80]
        jobs.append(tasks.Job(
            name, case.variant, f"{readable}-{digest}", str(model), str(weather),
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
def _files(model: Path) -> list[str]:
    return _contents(model).files(model.parent)


@cache
def _digest_of(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""


def _digest(values: Any) -> str:
    return hashlib.sha256(json.dumps(values).encode(errors="surrogatepass")).hexdigest()[:16]


def _pair(text: str) -> tuple[str, str]:
    type_, _, pattern = text.partition("/")
    return type_, pattern or "*"


@lru_cache(maxsize=1)
def _energyplus_version() -> str:
    marker = _programs.prefix() / ".gpu_shading_prefix.json"
    return str(json.loads(marker.read_bytes())["version"]) if marker.is_file() else ""


def _site(weather: str) -> list[str]:
    """Latitude, longitude and time zone, which the positions of the sun follow from."""
    with open(weather, encoding="latin-1") as lines:
        return lines.readline().strip().split(",")[6:9]


def _time_one(job: tasks.Job) -> float:
    with tempfile.TemporaryDirectory(prefix="gpu_shading_study_") as folder:
        began = time.monotonic()
        outcome = tasks.run(replace(job, folder=folder), "", None, True)
        if outcome.error:
            raise RunError(f"{job.name}: {outcome.error}")
        return time.monotonic() - began


class _Results:
    """The runs that are done, and those that failed this time."""

    def __init__(self, folder: Path, jobs: Sequence[tasks.Job]) -> None:
        self._folder, self._jobs = folder, jobs
        self._known: dict[str, tuple[tasks.Outcome, int]] = {}
        self._attempts = _earlier_attempts(folder)
        for job in jobs:
            record = folder / "runs" / job.id / tasks.RECORD
            if record.is_file():
                read = json.loads(record.read_text(encoding="utf-8"))
                self._known[job.id] = tasks.Outcome(values=read["values"], times=read["times"]), self._attempts.get(
                    job.name, 1)
        self._written = self._cost = 0.0

    def missing(self) -> list[tasks.Job]:
        return [job for job in self._jobs if job.id not in self._known]

    def add(self, job: tasks.Job, outcome: tasks.Outcome, attempts: int) -> None:
        self._known[job.id] = outcome, attempts
        if outcome.error:
            say(f"{job.name}: failed: {outcome.error}")
        if time.monotonic() - self._written > max(2.0, _WRITE_SHARE * self._cost):
            self.write()

    def write(self) -> None:
        began = time.monotonic()
        times = [{"run": job.name, "attempts": attempts, **outcome.times}
                 for job, outcome, attempts in self._in_order()]
        write_tables(self._folder, self.rows(), times)
        self._written = time.monotonic()
        self._cost = self._written - began

    def rows(self) -> list[dict[str, Any]]:
        return [self._row(job, outcome) for job, outcome, _ in self._in_order()]

    def mean_seconds(self) -> float | None:
        seconds = [outcome.times["seconds"] for _, outcome, _ in self._in_order() if outcome.times]
        return sum(seconds) / len(seconds) if seconds else None

    def _in_order(self) -> list[tuple[tasks.Job, tasks.Outcome, int]]:
        return [(job, *self._known[job.id]) for job in self._jobs if job.id in self._known]

    def _row(self, job: tasks.Job, outcome: tasks.Outcome) -> dict[str, Any]:
        weather = Path(job.weather).stem
        model = job.name.removesuffix(f"/{weather}").removesuffix(f"/{job.variant}")
        return {"run": job.name, "model": model, "variant": job.variant, "weather": weather,
                "status": "failed" if outcome.error else "done", "message": outcome.error,
                "inputs": job.id.rpartition("-")[2], "gpu_shading": __version__, "energyplus": _energyplus_version(),
                **outcome.values}


def _earlier_attempts(folder: Path) -> dict[str, int]:
    try:
        with open(folder / "times.csv", newline="", encoding="utf-8") as lines:
            return {row["run"]: int(row["attempts"]) for row in csv.DictReader(lines)}
    except (OSError, KeyError, ValueError):
        return {}


@dataclass
class _Group:
    """Runs that share their shading: the first computes it, the others read it."""

    folder: str
    waiting: list[tasks.Job] = field(default_factory=list)
    is_ready: bool = False
    has_first: bool = False


class _Schedule:
    """Asks for the hashes of scenes in the order of the plan; runs begin once those of all runs before them are known,
    so that the first of a group is always the same."""

    def __init__(self, jobs: Sequence[tasks.Job], folder: Path, done: _Results, engine: Engine) -> None:
        self._jobs, self._folder, self._done, self._engine = jobs, folder, done, engine
        self._todo = {job.id for job in done.missing()}
        self._scenes: dict[str, tuple[tasks.Outcome, int]] = {}
        self._groups: dict[str, _Group] = {}
        self._next = 0
        self._progress = Progress(len(jobs), len(jobs) - len(self._todo))

    def run(self) -> None:
        asked: set[str] = set()
        for job in self._jobs:
            if job.scene_id not in asked:
                asked.add(job.scene_id)
                self._engine.submit(tasks.scene_of, job, then=partial(self._take_scene, job))
        self._engine.run()
        self._progress.end()

    def _take_scene(self, job: tasks.Job, outcome: tasks.Outcome, attempts: int) -> None:
        self._scenes[job.scene_id] = outcome, attempts
        while self._next < len(self._jobs) and self._jobs[self._next].scene_id in self._scenes:
            self._begin(self._jobs[self._next])
            self._next += 1

    def _begin(self, job: tasks.Job) -> None:
        outcome, attempts = self._scenes[job.scene_id]
        if outcome.error:
            if job.id in self._todo:
                self._finish(job, outcome, attempts)
            return
        scene = outcome.values["scene"]
        if "cache" in job.options:  # the user's own
            if job.id in self._todo:
                self._submit(job, scene, None, True)
            return
        key = _digest([scene, _site(job.weather), job.options.get("update"), list(job.arguments)])
        group = self._groups.get(key)
        if group is None:
            group = self._groups[key] = _Group(str(self._folder / "shading" / f"{scene}-{key}"))
            group.is_ready = Path(group.folder).is_dir() and job.id not in self._todo
        if job.id not in self._todo:
            return
        group.waiting.append(job)
        self._advance(group, scene)

    def _advance(self, group: _Group, scene: str) -> None:
        if group.is_ready:
            for job in group.waiting:
                self._submit(job, scene, group, False)
            group.waiting.clear()
        elif group.waiting and not group.has_first:
            group.has_first = True
            self._submit(group.waiting.pop(0), scene, group, True)

    def _submit(self, job: tasks.Job, scene: str, group: _Group | None, is_first: bool) -> None:
        def then(outcome: tasks.Outcome, attempts: int) -> None:
            self._finish(job, outcome, attempts)
            if group is not None and is_first:
                group.has_first, group.is_ready = False, not outcome.error
                self._advance(group, scene)

        # Others wait for the first of a group.
        self._engine.submit(tasks.run, job, scene, group.folder if group else None, is_first, then=then,
                            priority=2 if is_first else 1)

    def _finish(self, job: tasks.Job, outcome: tasks.Outcome, attempts: int) -> None:
        self._done.add(job, outcome, attempts)
        self._progress.add(bool(outcome.error))
