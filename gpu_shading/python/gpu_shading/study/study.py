"""A study: a plan, the workers, and the folder of the results."""

from __future__ import annotations

import contextlib
import math
import os
import re
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from gpu_shading import _programs
from gpu_shading._text import escaped, quoted
from gpu_shading.errors import InvalidInput, RunError
from gpu_shading.study import tasks
from gpu_shading.study.engine import Engine, Workers, opened_workers
from gpu_shading.study.folder import check, occupied
from gpu_shading.study.jobs import make_jobs
from gpu_shading.study.plan import LARGEST, Case, is_number, read_plan
from gpu_shading.study.progress import Progress, in_words, say
from gpu_shading.study.records import Results
from gpu_shading.study.sampling import MODES, Sampling
from gpu_shading.study.schedule import Schedule


class Study:
    """Runs of EnergyPlus, from a plan (a TOML or CSV file) or from Cases of any iterable.

    `folder`: where the table and what is kept go. A study that is run again with the same folder does what is missing.
    `workers`: processes on this machine, as many as cores if None; or the address of a Dask `scheduler`; or a
    `client` of Dask; or a `jobqueue`: {"kind": "slurm", "workers": 20, and arguments of dask-jobqueue's cluster}.
    `outputs`: output variables for the table, over the run period. `keep`: "tables", "sql", "all" or "nothing" of each
    run. `limit`: seconds, after which a run is stopped. `tries`: how often a run that fails is tried. `task`: "run", or
    "sample" to sample each model as gpu_shading.sample does, with a `mode`, the work of each split into `shards`.
    """

    def __init__(self, plan: _programs.Name | Iterable[Case], folder: _programs.Name, *, workers: int | None = None,
                 scheduler: str | None = None, jobqueue: Mapping[str, Any] | None = None,
                 outputs: Sequence[str] | None = None, keep: Sequence[str] | None = None, limit: float | None = None,
                 tries: int | None = None, task: str | None = None, mode: str | None = None,
                 shards: int | None = None, client: Any = None) -> None:
        if not os.fspath(folder):
            raise InvalidInput("the folder of the study: '', expected its name")
        self.folder = Path(os.path.abspath(folder))
        given: Mapping[str, Any] = {}
        source = "study"
        if isinstance(plan, (str, os.PathLike)):
            read = read_plan(plan)
            cases, given, source = list(read.cases), read.settings, str(plan)
        else:
            cases = list(plan)
        self.client, self.scheduler = client, scheduler
        self.workers = _number("--workers", "workers", workers)
        self.jobqueue: dict[str, Any] = {**given.get("jobqueue", {}), **(jobqueue or {})}
        if not jobqueue and "kind" not in self.jobqueue:
            self.jobqueue = {}
        _check_jobqueue(source, self.jobqueue)
        self.task = _choice(source, "task", task or given.get("task", "run"), ("run", "sample"))
        self.mode = _choice(source, "mode", mode or given.get("mode", "medium"), MODES)
        self.shards = _number("shards", "shards", shards) or given.get("shards", 1)
        self.tries = _number("--tries", "tries", tries) or given.get("tries", 2)
        kept = (keep,) if isinstance(keep, str) else tuple(keep or given.get("keep", ("tables",)))
        for kind in kept:
            _choice(source, "keep", kind, tasks.KEEP)
        limit = _number("--limit", "limit", limit, whole=False) or given.get("limit")
        self.jobs = make_jobs(cases, source, self.folder, tuple(outputs or given.get("outputs", ())), kept, limit,
                              [self.task, self.mode] if self.task == "sample" else [])

    def run(self) -> list[dict[str, Any]]:
        """Runs what is missing, and returns the rows of the table in the order of the plan. Those of runs that failed
        have the status "failed", and a message."""
        with occupied(self.folder) as work:
            done = Results(self.folder, [replace(job, work=str(work)) for job in self.jobs])
            if done.missing():
                progress = Progress(len(self.jobs), len(self.jobs) - len(done.missing()))

                def finish(job: tasks.Job, outcome: tasks.Outcome, attempts: int) -> None:
                    done.add(job, outcome, attempts)
                    progress.add(bool(outcome.error))

                with self._workers(work) as workers:
                    engine = Engine(workers, self.tries)
                    if self.task == "sample":
                        Sampling(engine, self.mode, self.shards, finish).run(done.missing())
                    else:
                        Schedule(done.jobs, self.folder, {job.id for job in done.missing()}, engine, finish,
                                 progress.add_check).run()
                progress.end()
            done.write()
            return done.rows()

    def dry_run(self) -> str:
        """How many runs and distinct scenes there are, and about how long the runs will take. Nothing is written into
        the study's folder."""
        return "\n".join(self.estimate()[0])

    def estimate(self) -> tuple[list[str], bool]:
        """The lines of dry_run(), and whether a scene is refused."""
        check(self.folder)
        done = Results(self.folder, self.jobs)
        with self._workers(None) as open_workers:
            engine, scenes = Engine(open_workers, 1), dict[str, str]()
            errors: list[str] = []

            def note(job: tasks.Job, outcome: tasks.Outcome, _: int) -> None:
                if outcome.error:
                    errors.append(f"{job.name}: {outcome.error}")
                else:
                    scenes[job.scene_id] = outcome.values["scene"]

            for job in {job.scene_id: job for job in self.jobs}.values():
                engine.submit(tasks.scene_of, job, then=partial(note, job))
            engine.run()
            workers = max(engine.workers(), 1)
        missing = done.missing()
        lines = [f"{len(self.jobs)} runs, {len(self.jobs) - len(missing)} of them done, with "
                 f"{len(set(scenes.values()))} distinct scenes"]
        first = next((job for job in missing if job.scene_id in scenes), None)
        if first is not None:
            seconds, origin = done.mean_seconds(), "the runs that are done"
            if seconds is None:
                seconds, origin = _time_one(first), f"one run of {first.name}"
            lines.append(f"about {in_words(seconds * len(missing) / workers)} on {workers} workers, by {origin} "
                         f"({seconds:.1f} s)")
        return [escaped(line) for line in [*lines, *errors]], bool(errors)

    @contextlib.contextmanager
    def _workers(self, work: Path | None) -> Iterator[Workers]:
        if self.client is not None:
            yield Workers(self.client, math.inf)
            return
        with opened_workers(self.workers, self.scheduler, self.jobqueue, self.tries, work) as workers:
            client = workers.client
            link = client.dashboard_link
            if "scheduler_options" not in self.jobqueue and client.cluster is not None:
                link = re.sub("//[^:/]+:", "//127.0.0.1:", link)  # it is for this machine alone
            say(f"workers of {client.scheduler.address}; dashboard {link}")
            yield workers


def _choice(source: str, key: str, value: str, among: Sequence[str]) -> str:
    if value not in among:
        raise InvalidInput(f"{source}: {key}: {quoted(value)}, expected one of {', '.join(among)}")
    return value


def _number(name: str, key: str, value: Any, whole: bool = True) -> Any:
    if value is not None and not is_number(value, 1, LARGEST[key], whole):
        raise InvalidInput(f"{name}: {quoted(value)}, expected at least 1 and at most {LARGEST[key]:g}")
    return value


def _check_jobqueue(source: str, jobqueue: Mapping[str, Any]) -> None:
    for key, (least, largest) in {"workers": (0, LARGEST["workers"]), "wait": (1, LARGEST["limit"])}.items():
        if key in jobqueue and not is_number(jobqueue[key], least, largest, key == "workers"):
            raise InvalidInput(f"{source}: jobqueue.{key}: {quoted(jobqueue[key])}, expected at least {least} and at "
                               f"most {largest:g}")
    prologue = jobqueue.get("job_script_prologue", [])
    if not isinstance(prologue, (list, tuple)):
        raise InvalidInput(f"{source}: jobqueue.job_script_prologue: {quoted(prologue)}, expected a list of commands")


def _time_one(job: tasks.Job) -> float:
    with tempfile.TemporaryDirectory(prefix="gpu_shading_study_") as folder:
        began = time.monotonic()
        outcome = tasks.run(replace(job, folder=folder, work=folder), "", None, True)
        if outcome.error:
            raise RunError(f"{job.name}: {outcome.error}")
        return time.monotonic() - began
