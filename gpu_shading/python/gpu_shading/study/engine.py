"""Tasks on the workers of Dask."""

from __future__ import annotations

import asyncio
import contextlib
import importlib
import logging
import os
import shlex
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gpu_shading.errors import InvalidInput, RunError
from gpu_shading.study.plan import check_jobqueue
from gpu_shading.study.tasks import Outcome

_CLUSTERS = {"slurm": "SLURMCluster", "pbs": "PBSCluster", "lsf": "LSFCluster"}

# Run by every worker on this machine: it ends when the command is killed. A signal at the parent's death would come
# when the thread that started the worker ends.
_WATCH_PARENT = """
import os, threading, time

def watch(parent):
    while os.getppid() == parent:
        time.sleep(0.5)
    os._exit(1)

threading.Thread(target=watch, args=(os.getppid(),), daemon=True).start()
"""


def open_client(workers: int | None, scheduler: str | None, jobqueue: Mapping[str, Any], tries: int) -> Any:
    """A client of Dask: of the scheduler, of workers that a queue starts, or of `workers` processes here."""
    try:
        dask, distributed = importlib.import_module("dask"), importlib.import_module("distributed")
    except ImportError:
        raise ImportError("a study needs Dask: pip install distributed pyarrow, or the wheel with [study]") from None
    # What a dead worker was to do next is not blamed, because it is not sent ahead.
    dask.config.set({"distributed.scheduler.allowed-failures": tries - 1,
                     "distributed.scheduler.worker-saturation": 1.0,
                     # Workers here are forked from a process that has imported Dask, which takes half a second.
                     "distributed.worker.multiprocessing-method": "forkserver",
                     "distributed.worker.preload": [_WATCH_PARENT] if not (scheduler or jobqueue) else []})
    if scheduler:
        try:
            return distributed.Client(scheduler, timeout=20)
        except (OSError, ValueError, TypeError) as error:
            raise RunError(f"--scheduler {scheduler}: {error}; expected an address such as tcp://host:8786") from None
    if jobqueue:
        cluster = open_jobqueue(jobqueue)
    else:
        cluster = distributed.LocalCluster(n_workers=workers or os.cpu_count(), threads_per_worker=1,
                                           dashboard_address="127.0.0.1:0", silence_logs=logging.CRITICAL,
                                           env=dict(os.environ))
    return distributed.Client(cluster)


def open_jobqueue(jobqueue: Mapping[str, Any]) -> Any:
    """A cluster of dask-jobqueue: `kind`, `workers`, and the arguments of its cluster, such as queue and walltime."""
    try:
        module = importlib.import_module("dask_jobqueue")
    except ImportError:
        raise ImportError("--jobqueue needs dask-jobqueue: pip install dask-jobqueue") from None
    resources: dict[str, Any] = {"cores": 1, "processes": 1, "memory": "2 GB", **jobqueue}
    resources["job_script_prologue"] = [*_variables_of_jobs(), *resources.get("job_script_prologue", ())]
    kind, workers = check_jobqueue(str(resources.pop("kind", ""))), resources.pop("workers", 1)
    try:
        cluster = getattr(module, _CLUSTERS[kind])(**resources)
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"jobqueue: {error}") from None
    # Jobs that end, as at their walltime, are replaced.
    cluster.adapt(minimum=workers, maximum=workers)
    return cluster


def _variables_of_jobs() -> list[str]:
    """This package and EnergyPlus need not be those that a job would find by itself."""
    values = {"PYTHONPATH": str(Path(__file__).resolve().parents[2]),
              "GPU_SHADING_PREFIX": os.environ.get("GPU_SHADING_PREFIX", "")}
    later = {"PYTHONPATH": "${PYTHONPATH:+:$PYTHONPATH}"}
    return [f"export {name}={shlex.quote(value)}{later.get(name, '')}" for name, value in values.items() if value]


@contextlib.contextmanager
def _needing_scheduler() -> Iterator[None]:
    try:
        yield
    except (OSError, asyncio.CancelledError) as error:
        raise RunError(f"Dask's scheduler is gone ({error}); the same command resumes") from None


@dataclass
class _Task:
    function: Callable[..., Outcome]
    arguments: tuple[Any, ...]
    then: Callable[[Outcome, int], None]
    attempt: int
    priority: int


class Engine:
    """Submits tasks, tries again those that fail, and hands on each outcome with its number of attempts."""

    def __init__(self, client: Any, tries: int) -> None:
        self._client, self._tries = client, tries
        self._completed = importlib.import_module("distributed").as_completed([])
        self._tasks: dict[Any, _Task] = {}

    def workers(self) -> int:
        return len(self._client.scheduler_info(n_workers=-1)["workers"])

    def submit(self, function: Callable[..., Outcome], *arguments: Any, then: Callable[[Outcome, int], None],
               priority: int = 0) -> None:
        self._start(_Task(function, arguments, then, 1, priority))

    def _start(self, task: _Task) -> None:
        with _needing_scheduler():
            future = self._client.submit(task.function, *task.arguments, pure=False, priority=task.priority)
        self._tasks[future] = task
        self._completed.add(future)

    def run(self) -> None:
        """Until nothing is left; what outcomes lead to may submit more."""
        for future in self._completed:
            if future.status in ("lost", "pending"):
                # Its worker died with the result, so that the scheduler runs it again.
                self._completed.add(future)
                continue
            task = self._tasks.pop(future)
            with _needing_scheduler():
                outcome, died = self._outcome(future)
            if outcome.error and task.attempt < self._tries and not died:
                task.attempt += 1
                self._start(task)
            else:
                task.then(outcome, self._tries if died else task.attempt)

    def _outcome(self, future: Any) -> tuple[Outcome, bool]:
        """And whether it killed its worker again and again."""
        if future.status == "finished":
            return future.result(), False
        if future.status != "error":
            raise asyncio.CancelledError(f"a task is {future.status}")
        error = future.exception()
        if type(error).__name__ == "KilledWorker":
            return Outcome(f"its worker died {self._tries} times"), True
        return Outcome(f"{type(error).__name__}: {error}"), False
