"""Tasks on the workers of Dask."""

from __future__ import annotations

import asyncio
import contextlib
import importlib
import logging
import os
import shlex
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gpu_shading import _files
from gpu_shading._text import of_error
from gpu_shading.errors import Error, InvalidInput, RunError
from gpu_shading.study.plan import check_jobqueue
from gpu_shading.study.progress import in_words, say
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


# Seconds after which it is an error that no worker is there.
_LOCAL_PATIENCE = 60.0
_QUEUE_PATIENCE = 86_400.0
_SCHEDULER_PATIENCE = 600.0
_CLOSING = 10.0
_LONGEST_TEMPORARY = 70  # bytes: names of sockets may have 107, of which Python's own part takes 32
_LOOK = 2.0  # s, between two looks at the workers
_SAY = 300.0


@dataclass(frozen=True)
class Workers:
    """A client of Dask, and the seconds after which it is an error that no worker is there."""

    client: Any
    patience: float


@contextlib.contextmanager
def opened_workers(workers: int | None, scheduler: str | None, jobqueue: Mapping[str, Any], tries: int,
                   work: Path | None) -> Iterator[Workers]:
    """Those of the scheduler, those that a queue starts, or `workers` processes here. `work`: the study's folder for
    what is temporary, on the disk of all hosts; None in a dry run."""
    try:
        dask, distributed = importlib.import_module("dask"), importlib.import_module("distributed")
    except ImportError:
        raise ImportError("a study needs Dask: pip install cryptography distributed pyarrow, or the wheel with "
                          "[study]") from None
    with contextlib.ExitStack() as stack:
        # Workers import modules from their folder, so that nobody else may write there.
        temporary = tempfile.gettempdir()
        if len(os.fsencode(temporary)) > _LONGEST_TEMPORARY:
            raise RunError(f"TMPDIR is {temporary}: workers need a path of at most {_LONGEST_TEMPORARY} bytes")
        place = stack.enter_context(_files.private_folder(Path(temporary)))
        # What a dead worker was to do next is not blamed, because it is not sent ahead.
        stack.enter_context(dask.config.set({
            "temporary-directory": str(place),
            "distributed.scheduler.allowed-failures": tries - 1,
            "distributed.scheduler.worker-saturation": 1.0,
            # Workers here are forked from a process that has imported Dask, which takes half a second.
            "distributed.worker.multiprocessing-method": "forkserver",
            "distributed.worker.preload": [_WATCH_PARENT] if not (scheduler or jobqueue) else []}))
        if scheduler:
            yield Workers(stack.enter_context(_connected(distributed, scheduler)), _SCHEDULER_PATIENCE)
            return
        if jobqueue:
            cluster = open_jobqueue(jobqueue, work or place)
        else:
            cluster = _open_local(distributed, place, workers or os.cpu_count() or 1)
        stack.callback(_close, cluster)
        patience = jobqueue.get("wait", _QUEUE_PATIENCE) if jobqueue else _LOCAL_PATIENCE
        yield Workers(stack.enter_context(distributed.Client(cluster)), patience)


def _connected(distributed: Any, scheduler: str) -> Any:
    try:
        return distributed.Client(scheduler, timeout=20)
    except (OSError, ValueError, TypeError) as error:
        raise RunError(f"--scheduler {scheduler}: {of_error(error)}; expected an address such as "
                       "tcp://host:8786") from None


def _security(distributed: Any) -> Any:
    """Certificates of this study alone: nobody else can give its workers something to run."""
    try:
        return distributed.Security.temporary()
    except ImportError:
        raise ImportError("a study needs cryptography: pip install cryptography, or the wheel with [study]") from None


def _security_of_jobs(distributed: Any, place: Path) -> Any:
    """The same, in files of the private folder."""
    made = _security(distributed)
    certificate, key = str(place / "certificate.pem"), str(place / "key.pem")
    for name, content in ((certificate, made.tls_ca_file), (key, made.tls_worker_key)):
        with open(os.open(name, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600), "w", encoding="ascii") as file:
            file.write(content)
    roles = {f"tls_{role}_{kind}": name for role in ("client", "scheduler", "worker")
             for kind, name in (("cert", certificate), ("key", key))}
    return distributed.Security(require_encryption=True, tls_ca_file=certificate, **roles)


def _open_local(distributed: Any, place: Path, workers: int) -> Any:
    _start_helpers(place)
    cluster = distributed.LocalCluster(n_workers=0, threads_per_worker=1, dashboard_address="127.0.0.1:0",
                                       memory_limit=distributed.system.MEMORY_LIMIT // workers,
                                       silence_logs=logging.CRITICAL, security=_security(distributed),
                                       env=dict(os.environ))
    # Not by the constructor, which waits for a worker that cannot start.
    cluster.scale(workers)
    end = time.monotonic() + _LOCAL_PATIENCE
    while len(cluster.scheduler.workers) < workers and time.monotonic() < end:
        time.sleep(0.02)
    if not cluster.scheduler.workers:
        _close(cluster)
        raise RunError(f"no worker could start within {_LOCAL_PATIENCE:.0f} s; expected room for {workers} processes "
                       "(--workers)")
    return cluster


def _close(cluster: Any) -> None:
    """Within bounds, even if a worker hangs."""
    with contextlib.suppress(asyncio.TimeoutError, TimeoutError):
        cluster.close(timeout=_CLOSING)


def _start_helpers(place: Path) -> None:
    """Python starts processes by `python -c`, which imports modules of the current folder; Python 3.10 ignores
    PYTHONSAFEPATH. Those that start all others begin in a folder of ours."""
    importlib.import_module("distributed.utils").get_mp_context()
    here = os.open(".", os.O_RDONLY | os.O_DIRECTORY)
    safe = os.environ.get("PYTHONSAFEPATH")
    try:
        os.chdir(place)
        os.environ["PYTHONSAFEPATH"] = "1"
        importlib.import_module("multiprocessing.forkserver").ensure_running()
    finally:
        os.fchdir(here)
        os.close(here)
        if safe is None:
            del os.environ["PYTHONSAFEPATH"]
        else:
            os.environ["PYTHONSAFEPATH"] = safe


def open_jobqueue(jobqueue: Mapping[str, Any], place: Path) -> Any:
    """A cluster of dask-jobqueue: `kind`, `workers`, and the arguments of its cluster, such as queue and walltime.
    `place`: a private folder on the disk of all hosts, where workers start."""
    try:
        module = importlib.import_module("dask_jobqueue")
    except ImportError:
        raise ImportError("--jobqueue needs dask-jobqueue: pip install dask-jobqueue") from None
    given = dict(jobqueue)
    kind, workers = check_jobqueue(str(given.pop("kind", ""))), given.pop("workers", 1)
    given.pop("wait", None)
    resources: dict[str, Any] = {
        "cores": 1, "processes": 1, "memory": "2 GB", "local_directory": str(place),
        "security": _security_of_jobs(importlib.import_module("distributed"), place), **given,
        "scheduler_options": {"dashboard_address": "127.0.0.1:0", **given.get("scheduler_options", {})},
        "job_script_prologue": [*_variables_of_jobs(), *given.get("job_script_prologue", ()),
                                f"cd {shlex.quote(str(place))}"]}
    try:
        cluster = getattr(module, _CLUSTERS[kind])(**resources)
    except (OSError, TypeError, ValueError) as error:
        raise InvalidInput(f"jobqueue: {of_error(error)}") from None
    # Jobs that end, as at their walltime, are replaced.
    cluster.adapt(minimum=workers, maximum=workers)
    return cluster


def _variables_of_jobs() -> list[str]:
    """This package and EnergyPlus need not be those that a job would find by itself."""
    values = {"PYTHONPATH": str(Path(__file__).resolve().parents[2]), "PYTHONSAFEPATH": "1",
              # The folder is on the disk of all hosts, where locks may be missing.
              "DASK_DISTRIBUTED__WORKER__USE_FILE_LOCKING": "False",
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

    def __init__(self, workers: Workers, tries: int) -> None:
        self._client, self._patience, self._tries = workers.client, workers.patience, tries
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
        while self._tasks:
            self._wait()
            future = next(self._completed)
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

    def _wait(self) -> None:
        """Until a task has ended. Raises RunError if there is no worker for too long."""
        began = looked = said = time.monotonic()
        while not self._completed.has_ready():
            time.sleep(0.01)
            now = time.monotonic()
            if now - looked < _LOOK:
                continue
            looked = now
            if self.workers():
                began = now
            elif now - began > self._patience:
                raise RunError(f"no worker for {in_words(now - began)}; the same command resumes")
            elif now - max(began, said) > _SAY:
                said = now
                say(f"no worker for {in_words(now - began)}; waiting for up to {in_words(self._patience)}")

    def _outcome(self, future: Any) -> tuple[Outcome, bool]:
        """And whether it killed its worker again and again."""
        if future.status == "finished":
            return future.result(), False
        if future.status != "error":
            raise asyncio.CancelledError(f"a task is {future.status}")
        error = future.exception()
        if type(error).__name__ == "KilledWorker":
            return Outcome(f"its worker died {self._tries} times"), True
        return Outcome(of_error(error) if isinstance(error, Error) else f"{type(error).__name__}: {error}"), False
