"""A study: a plan, the workers, and the folder of the results."""

from __future__ import annotations

import contextlib
import fcntl
import os
import shutil
import tempfile
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from gpu_shading import _programs
from gpu_shading.errors import InvalidInput, RunError
from gpu_shading.study import tasks
from gpu_shading.study.engine import Engine, open_client
from gpu_shading.study.jobs import make_jobs
from gpu_shading.study.plan import Case, read_plan
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
        self.folder = Path(folder).absolute()
        given: Mapping[str, Any] = {}
        source = "study"
        if isinstance(plan, (str, os.PathLike)):
            read = read_plan(plan)
            cases, given, source = list(read.cases), read.settings, str(plan)
        else:
            cases = list(plan)
        self.client, self.workers, self.scheduler = client, workers, scheduler
        self.jobqueue: dict[str, Any] = {**given.get("jobqueue", {}), **(jobqueue or {})}
        if not jobqueue and "kind" not in self.jobqueue:
            self.jobqueue = {}
        self.task = _choice(source, "task", task or given.get("task", "run"), ("run", "sample"))
        self.mode = _choice(source, "mode", mode or given.get("mode", "medium"), MODES)
        self.shards = int(shards or given.get("shards", 1))
        self.tries = int(tries or given.get("tries", 2))
        kept = (keep,) if isinstance(keep, str) else tuple(keep or given.get("keep", ("tables",)))
        for kind in kept:
            _choice(source, "keep", kind, tasks.KEEP)
        self.jobs = make_jobs(cases, source, self.folder, tuple(outputs or given.get("outputs", ())), kept,
                          limit or given.get("limit"), [self.task, self.mode] if self.task == "sample" else [])

    def run(self) -> list[dict[str, Any]]:
        """Runs what is missing, and returns the rows of the table in the order of the plan. Those of runs that failed
        have the status "failed", and a message."""
        with _only_one(self.folder):
            done = Results(self.folder, self.jobs)
            if done.missing():
                progress = Progress(len(self.jobs), len(self.jobs) - len(done.missing()))

                def finish(job: tasks.Job, outcome: tasks.Outcome, attempts: int) -> None:
                    done.add(job, outcome, attempts)
                    progress.add(bool(outcome.error))

                with self._client() as client:
                    engine = Engine(client, self.tries)
                    if self.task == "sample":
                        Sampling(engine, self.mode, self.shards, finish).run(done.missing())
                    else:
                        Schedule(self.jobs, self.folder, {job.id for job in done.missing()}, engine, finish,
                                 progress.add_check).run()
                progress.end()
            done.write()
            return done.rows()

    def dry_run(self) -> str:
        """How many runs and distinct scenes there are, and about how long the runs will take."""
        with _only_one(self.folder), self._client() as client:
            done, engine, scenes = Results(self.folder, self.jobs), Engine(client, 1), dict[str, str]()
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
        if missing:
            seconds, origin = done.mean_seconds(), "the runs that are done"
            if seconds is None:
                seconds, origin = _time_one(missing[0]), f"one run of {missing[0].name}"
            lines.append(f"about {in_words(seconds * len(missing) / workers)} on {workers} workers, by {origin} "
                         f"({seconds:.1f} s)")
        return "\n".join([*lines, *errors])

    @contextlib.contextmanager
    def _client(self) -> Any:
        if self.client is not None:
            yield self.client
            return
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


def _choice(source: str, key: str, value: str, among: Sequence[str]) -> str:
    if value not in among:
        raise InvalidInput(f"{source}: {key}: {value!r}, expected one of {', '.join(among)}")
    return value


def _time_one(job: tasks.Job) -> float:
    with tempfile.TemporaryDirectory(prefix="gpu_shading_study_") as folder:
        began = time.monotonic()
        outcome = tasks.run(replace(job, folder=folder), "", None, True)
        if outcome.error:
            raise RunError(f"{job.name}: {outcome.error}")
        return time.monotonic() - began
