"""Studies whose task is sampling: gpu_shading sample for each model, in shards where there are few models."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from gpu_shading._text import of_error
from gpu_shading.errors import RunError
from gpu_shading.study.engine import Engine
from gpu_shading.study.inputs import is_own_folder
from gpu_shading.study.tasks import Job, Outcome, run_program, work_folder, write_record

MODES = ("fine", "medium", "coarse")
_ALL_THERE = "rounds are complete"


def sample(job: Job, mode: str, words: list[str]) -> Outcome:
    """Samples a model into runs/ID: all of it, or one share of a round, or the tables of all shares."""
    began = time.monotonic()
    target = Path(job.folder) / "runs" / job.id
    try:
        if not is_own_folder(target):
            target.mkdir(parents=True, exist_ok=True)
        with work_folder(job) as folder:
            error, line = run_program(job, folder, ["sample", "-o", str(target), "--mode", mode, *words],
                                      folder / "output")
        if error:
            return Outcome(error)
        outcome = Outcome(values={"line": line})
        if "--shard" not in words:
            about = json.loads((target / "samples.json").read_bytes())
            outcome.values = {"scene": about["scene"], "directions rendered": about["directions"],
                              "receivers": len(about["receivers"])}
            outcome.times = {"seconds": round(time.monotonic() - began, 3)}
            write_record(target, outcome)
        return outcome
    except (OSError, KeyError, RunError, ValueError) as error:
        return Outcome(of_error(error))


class Sampling:
    """Shards render their shares of a round; a round begins once all shares of the last one are there. EnergyPlus keeps
    its scene for the next round where there are workers for all shards. Models are sampled side by side."""

    def __init__(self, engine: Engine, mode: str, shards: int, finish: Callable[[Job, Outcome, int], None]) -> None:
        self._engine, self._mode, self._shards, self._finish = engine, mode, shards, finish

    def run(self, jobs: Sequence[Job]) -> None:
        for job in jobs:
            if self._shards == 1:
                self._submit_last(job, [])
            else:
                self._begin_round(job)
        self._engine.run()

    def _submit_last(self, job: Job, words: list[str]) -> None:
        self._engine.submit(sample, job, self._mode, words, then=partial(self._finish, job))

    def _begin_round(self, job: Job) -> None:
        outcomes: list[tuple[Outcome, int]] = []

        def take(outcome: Outcome, attempts: int) -> None:
            outcomes.append((outcome, attempts))
            if len(outcomes) < self._shards:
                return
            failed = next((found for found in outcomes if found[0].error), None)
            if failed:
                self._finish(job, *failed)
            elif any(_ALL_THERE in found.values["line"] for found, _ in outcomes):
                self._submit_last(job, ["--merge", str(self._shards)])
            else:
                self._begin_round(job)

        patience = 10 if self._engine.workers() >= self._shards else 0  # s
        for shard in range(1, self._shards + 1):
            self._engine.submit(sample, job, self._mode,
                                ["--shard", f"{shard}/{self._shards}", "--wait", f"{patience}"], then=take)
