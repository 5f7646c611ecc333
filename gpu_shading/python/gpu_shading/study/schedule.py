"""Which runs share shading, and in which order they are run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from gpu_shading.study import tasks
from gpu_shading.study.engine import Engine
from gpu_shading.study.inputs import MAX_TABLE, is_own_folder, opened
from gpu_shading.study.tasks import digest

_MAX_LINE = 1000  # bytes


def _site(weather: str) -> list[str]:
    """Latitude, longitude and time zone, which the positions of the sun follow from."""
    with opened(Path(weather), MAX_TABLE) as file:
        return file.readline(_MAX_LINE).decode("latin-1").strip().split(",")[6:9]


@dataclass
class _Group:
    """Runs that share their shading: the first computes it, the others read it."""

    folder: str
    waiting: list[tasks.Job] = field(default_factory=list)
    is_ready: bool = False
    has_first: bool = False


class Schedule:
    """Checks the distinct scenes first, so that errors of a model are not told hours later. Runs begin in the order of
    the plan, so that the first of a group is always the same."""

    def __init__(self, jobs: Sequence[tasks.Job], folder: Path, todo: set[str], engine: Engine,
                 finish: Callable[[tasks.Job, tasks.Outcome, int], None], checked: Callable[[int, int], None]) -> None:
        self._jobs, self._folder, self._todo, self._engine, self._finish = jobs, folder, todo, engine, finish
        self._checked = checked
        self._scenes: dict[str, tuple[tasks.Outcome, int]] = {}
        self._groups: dict[str, _Group] = {}

    def run(self) -> None:
        first: dict[str, tasks.Job] = {}
        for job in self._jobs:
            first.setdefault(job.scene_id, job)

        def take(scene_id: str, outcome: tasks.Outcome, attempts: int) -> None:
            self._scenes[scene_id] = outcome, attempts
            self._checked(len(self._scenes), len(first))

        for scene_id, job in first.items():
            self._engine.submit(tasks.scene_of, job, then=partial(take, scene_id))
        self._engine.run()
        for job in self._jobs:
            self._begin(job)
        self._engine.run()

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
        key = digest([scene, _site(job.weather), job.options.get("update"), list(job.arguments)])
        group = self._groups.get(key)
        if group is None:
            group = self._groups[key] = _Group(str(self._folder / "shading" / f"{scene}-{key}"))
            group.is_ready = is_own_folder(Path(group.folder)) and job.id not in self._todo
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
