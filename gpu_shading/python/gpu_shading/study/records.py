"""What is known of the runs of a study: the records of those that are done, and those that failed this time."""

from __future__ import annotations

import contextlib
import csv
import io
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gpu_shading._library import __version__
from gpu_shading.errors import InvalidInput
from gpu_shading.study import tasks
from gpu_shading.study.folder import Tables
from gpu_shading.study.inputs import MAX_TABLE, is_own_folder, opened
from gpu_shading.study.jobs import energyplus_version
from gpu_shading.study.progress import say
from gpu_shading.study.table import write_tables

_WRITE_SHARE = 20  # the time between two tables is so many times that of writing one


class Results:
    """The runs that are done, and those that failed this time."""

    def __init__(self, folder: Path, jobs: Sequence[tasks.Job]) -> None:
        self.jobs = jobs
        self._known: dict[str, tuple[tasks.Outcome, int]] = {}
        self._attempts = _earlier_attempts(folder)
        for job in jobs:
            if outcome := _recorded(folder / "runs" / job.id):
                self._known[job.id] = outcome, self._attempts.get(job.name, 1)
        self._tables = Tables(folder)
        self._written = self._cost = 0.0

    def missing(self) -> list[tasks.Job]:
        return [job for job in self.jobs if job.id not in self._known]

    def add(self, job: tasks.Job, outcome: tasks.Outcome, attempts: int) -> None:
        self._known[job.id] = outcome, attempts
        if outcome.error:
            say(f"{job.name}: failed: {outcome.error}")
        if time.monotonic() - self._written > max(2.0, _WRITE_SHARE * self._cost):
            with contextlib.suppress(InvalidInput):  # write() says so at the end
                self.write()

    def write(self) -> None:
        began = time.monotonic()
        times = [{"run": job.name, "attempts": attempts, **outcome.times}
                 for job, outcome, attempts in self._in_order()]
        try:
            write_tables(self._tables, self.rows(), times)
        finally:
            self._written = time.monotonic()
            self._cost = self._written - began

    def rows(self) -> list[dict[str, Any]]:
        return [self._row(job, outcome) for job, outcome, _ in self._in_order()]

    def mean_seconds(self) -> float | None:
        seconds = [outcome.times["seconds"] for _, outcome, _ in self._in_order() if outcome.times]
        return sum(seconds) / len(seconds) if seconds else None

    def _in_order(self) -> list[tuple[tasks.Job, tasks.Outcome, int]]:
        return [(job, *self._known[job.id]) for job in self.jobs if job.id in self._known]

    def _row(self, job: tasks.Job, outcome: tasks.Outcome) -> dict[str, Any]:
        weather = Path(job.weather).stem
        model = job.name.removesuffix(f"/{weather}").removesuffix(f"/{job.variant}")
        return {"run": job.name, "model": model, "variant": job.variant, "weather": weather,
                "status": "failed" if outcome.error else "done", "message": outcome.error,
                "inputs": job.id.rpartition("-")[2], "gpu_shading": __version__, "energyplus": energyplus_version(),
                **outcome.values}


def _recorded(folder: Path) -> tasks.Outcome | None:
    """A damaged record counts as none."""
    if not is_own_folder(folder):
        return None
    try:
        return tasks.read_record(folder)
    except InvalidInput as error:
        say(f"{error}; this run is repeated")
        return None


def _earlier_attempts(folder: Path) -> dict[str, int]:
    try:
        with opened(folder / "times.csv", MAX_TABLE, follow=False) as table:
            lines = io.TextIOWrapper(table, encoding="utf-8", newline="")
            return {row["run"]: int(row["attempts"]) for row in csv.DictReader(lines)}
    except (OSError, InvalidInput, KeyError, TypeError, ValueError, csv.Error):
        return {}
