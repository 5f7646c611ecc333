"""What is known of the runs of a study: the records of those that are done, and those that failed this time."""

from __future__ import annotations

import csv
import json
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gpu_shading._library import __version__
from gpu_shading.study import tasks
from gpu_shading.study.jobs import energyplus_version
from gpu_shading.study.progress import say
from gpu_shading.study.table import write_tables

_WRITE_SHARE = 20  # the time between two tables is so many times that of writing one


class Results:
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
                "inputs": job.id.rpartition("-")[2], "gpu_shading": __version__, "energyplus": energyplus_version(),
                **outcome.values}


def _earlier_attempts(folder: Path) -> dict[str, int]:
    try:
        with open(folder / "times.csv", newline="", encoding="utf-8") as lines:
            return {row["run"]: int(row["attempts"]) for row in csv.DictReader(lines)}
    except (OSError, KeyError, ValueError):
        return {}
