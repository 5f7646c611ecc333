"""What workers do: the hash of a scene, and whole runs. A worker needs this package and the study's folder."""

from __future__ import annotations

import contextlib
import ctypes
import hashlib
import json
import os
import re
import resource
import secrets
import shutil
import signal
import socket
import sqlite3
import subprocess
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gpu_shading import _programs
from gpu_shading._files import private_folder, write_whole
from gpu_shading._text import of_error
from gpu_shading.errors import InvalidInput, RunError
from gpu_shading.runs import shading_errors
from gpu_shading.study import inputs, models, results

RECORD = "record.json"
_MAX_RECORD = 16 * inputs.MEBIBYTE
_SCENE = re.compile(r"[0-9a-f]{1,64}")
_MAX_SCENE = 100  # bytes
_TAKEN = ("error", "resolution", "device", "threads", "lean", "method", "assets", "file")  # by gpu_shading check
_KEPT = {"tables": ("eplustbl.*", "eplusout.err", "eplusout.eio"), "sql": ("eplusout.sql",), "all": ("*",),
         "nothing": ()}
KEEP = tuple(_KEPT)


@dataclass(frozen=True)
class Job:
    """A run, with all that decides its results."""

    name: str
    variant: str
    id: str
    """Of its folder: the name as far as a file may have it, and a digest of the inputs."""
    model: str
    weather: str
    extensions: str | None
    options: Mapping[str, str]
    fields: tuple[tuple[models.Field, str], ...]
    remove: tuple[tuple[str, str], ...]
    objects: str
    arguments: tuple[str, ...]
    outputs: tuple[str, ...]
    keep: tuple[str, ...]
    limit: float | None
    folder: str
    """Of the study."""
    scene_id: str
    """Of the inputs of the scene: those of the job without weather."""
    work: str = ""
    """A folder for what is temporary. In a dry run there is none, and nothing is kept."""


@dataclass
class Outcome:
    """Of an attempt."""

    error: str = ""
    values: dict[str, Any] = field(default_factory=dict)
    times: dict[str, Any] = field(default_factory=dict)


def digest(values: Any) -> str:
    return hashlib.sha256(json.dumps(values).encode(errors="surrogatepass")).hexdigest()[:16]


def write_record(folder: Path, outcome: Outcome) -> None:
    content = {"values": outcome.values, "times": outcome.times}
    write_whole(folder / RECORD, json.dumps({**content, "digest": digest(content)}, indent=1) + "\n")


def read_record(folder: Path) -> Outcome | None:
    """Of the run whose results are in the folder; None if it has none. Raises InvalidInput, with one line, if it is
    not as a study has written it."""
    path = folder / RECORD
    if not os.path.lexists(path):
        return None
    try:
        record = json.loads(inputs.read(path, _MAX_RECORD, follow=False))
        content = {"values": record["values"], "times": record["times"]}
        if record["digest"] != digest(content):
            raise ValueError("its checksum is wrong")
        return Outcome(**content)
    except (OSError, KeyError, TypeError, ValueError, RecursionError) as error:
        why = error.strerror if isinstance(error, OSError) else str(error).removeprefix(f"{path}: ")
        raise InvalidInput(f"{path}: is not a record of a study ({why})") from None


def end_with_parent() -> None:
    """In a child before its program starts: the kernel kills it when its parent ends, however that ends."""
    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGKILL)


def _run(command: list[str], folder: Path, limit: float | None,
         output: Path = Path(os.devnull)) -> tuple[int, str, bool]:
    """(exit status, standard error, whether the limit was reached); standard output goes into a file."""
    with open(output, "wb") as out, subprocess.Popen(
            command, cwd=folder, env=_programs.environment(), stdin=subprocess.DEVNULL, stdout=out,
            stderr=subprocess.PIPE, start_new_session=True, preexec_fn=end_with_parent) as process:
        hung = False
        try:
            errors = process.communicate(timeout=limit)[1]
        except subprocess.TimeoutExpired:
            hung = True
            os.killpg(process.pid, signal.SIGKILL)
            errors = process.communicate()[1]
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    return process.returncode, errors.decode(errors="replace"), hung


@contextlib.contextmanager
def work_folder(job: Job) -> Any:
    """A folder for one attempt, in the study's if this is not a dry run."""
    with contextlib.ExitStack() as stack:
        place = Path(job.work or stack.enter_context(private_folder(Path(tempfile.gettempdir()))))
        folder = place / f"{job.id}-{secrets.token_hex(4)}"
        folder.mkdir()
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)


def _write_model(job: Job, folder: Path, outputs: bool) -> tuple[Path, list[str]]:
    """The model with the job's changes, and output for the table if asked for, and the flags that it needs."""
    original = Path(job.model)
    flags = [f"--gpu-shading-{name}={value}" for name, value in job.options.items()]
    side_file = inputs.side_file(Path(job.extensions or original.with_suffix(".gpu-shading.idf")))
    if side_file is not None:
        flags.append(f"--gpu-shading-file={side_file}")
    if not (outputs or job.fields or job.remove or job.objects):
        return original, flags
    model = models.read(original)
    for type_, pattern in job.remove:
        model.remove(type_, pattern)
    for place, value in job.fields:
        model.set(place, value)
    if job.objects:
        model.append(job.objects)
    if outputs:
        model.remove("Output:SQLite")
        model.add("Output:SQLite", option_type="SimpleAndTabular", unit_conversion_for_tabular_data="JtoKWH")
        if not model.count("Output:Table:SummaryReports"):
            model.add("Output:Table:SummaryReports", report="AllSummary")
        for name in (results.TRANSMITTED, *job.outputs):
            model.add("Output:Variable", key_value="*", variable_name=name, reporting_frequency="RunPeriod")
    if model.anchor(original.parent):
        flags.append("--gpu-shading-assets=any")
    model.write(folder / original.name)
    return folder / original.name, flags


def run_program(job: Job, folder: Path, words: list[str], output: Path) -> tuple[str, str]:
    """Runs the gpu_shading program on the job's model. Returns what went wrong, "" if nothing did, and the last line
    of standard error."""
    model, flags = _write_model(job, folder, outputs=False)
    flags = [flag for flag in flags if flag.partition("=")[0].removeprefix("--gpu-shading-") in _TAKEN]
    status, errors, hung = _run([str(_programs.prefix() / "gpu_shading"), words[0], str(model), "-w", job.weather,
                                 *words[1:], *flags], folder, job.limit, output)
    lines = errors.strip().splitlines() or [""]
    if hung:
        return f"stopped after the limit of {job.limit:g} s, in gpu_shading {words[0]}", lines[-1]
    message = "" if status == 0 else _without(_programs.last_message(errors, "gpu_shading", status), folder)
    return message, lines[-1]


def scene_of(job: Job) -> Outcome:
    """The hash of the job's scene, which is kept in the study's folder."""
    kept = Path(job.folder) / "scenes" / job.scene_id
    try:
        with contextlib.suppress(OSError, InvalidInput, UnicodeDecodeError):
            scene = inputs.read(kept, _MAX_SCENE, follow=False).decode("ascii").strip()
            if _SCENE.fullmatch(scene):
                return Outcome(values={"scene": scene})
        with work_folder(job) as folder:
            document = folder / "check.json"
            if error := run_program(job, folder, ["check", "--json"], document)[0]:
                return Outcome(error)
            scene = str(json.loads(document.read_bytes())["scene"])
            if job.work:
                kept.parent.mkdir(exist_ok=True)
                (folder / "scene").write_text(scene + "\n", encoding="ascii")
                (folder / "scene").replace(kept)
    except (OSError, RunError, ValueError) as error:
        return Outcome(of_error(error))
    return Outcome(values={"scene": scene})


def run(job: Job, scene: str, shading: str | None, is_first: bool) -> Outcome:
    """Runs the job, and renames its folder to runs/ID when it is complete. `shading`: the folder with the answers of
    the runs that share its shading, which the first of them writes."""
    began, used = time.monotonic(), _processor_seconds()
    try:
        with work_folder(job) as folder:
            outcome = _run_in(job, folder, scene, shading, is_first)
            if not outcome.error:
                outcome.times = {"seconds": round(time.monotonic() - began, 3),
                                 "cpu seconds": round(_processor_seconds() - used, 3), "host": socket.gethostname()}
                _publish(job, folder, outcome, shading if is_first else None)
            return outcome
    except (OSError, RunError, ValueError, sqlite3.Error) as error:
        return Outcome(of_error(error))


def _processor_seconds() -> float:
    """Of the programs that this worker has run; a worker has one thread."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _run_in(job: Job, folder: Path, scene: str, shading: str | None, is_first: bool) -> Outcome:
    model, flags = _write_model(job, folder, outputs=True)
    out = folder / "out"
    out.mkdir()
    if shading is not None:
        # Of their own, so that what others add meanwhile does not change what is rendered.
        if not is_first and inputs.is_own_folder(Path(shading)):
            shutil.copytree(shading, folder / "cache", symlinks=True)
        flags.append(f"--gpu-shading-cache={folder / 'cache'}")
    if "threads" not in job.options:
        flags.append("--gpu-shading-threads=1")
    status, errors, hung = _run([str(_programs.prefix() / "energyplus"), "--gpu-shading", *flags, *job.arguments, "-w",
                                 job.weather, "-d", str(out), str(model)], folder, job.limit)
    report = _text(out / "eplusout.err")
    if hung:
        return Outcome(_without(f"stopped after the limit of {job.limit:g} s: {results.last_lines(report)}", folder))
    if status != 0 or "Completed Successfully" not in _text(out / "eplusout.end"):
        told = errors if "gpu_shading: error: " in errors else report or errors
        return Outcome(_without(results.last_lines(told) or f"exit status {status}", folder))
    rendered, recalled, warnings = results.read_messages(report)
    stated = shading_errors(out)
    values = {"scene": scene, "directions rendered": rendered, "directions from the cache": recalled,
              "largest error": stated.largest if stated and not stated.not_measured else None,
              "messages": _without(" | ".join(warnings), folder),
              **results.read_numbers(out / "eplusout.sql", job.outputs)}
    return Outcome(values=values)


def _publish(job: Job, folder: Path, outcome: Outcome, shading: str | None) -> None:
    patterns = {pattern for kind in job.keep for pattern in _KEPT[kind]}
    kept = folder / "kept"
    kept.mkdir()
    for path in {path for pattern in patterns for path in (folder / "out").glob(pattern)}:
        path.rename(kept / path.name)
    write_record(kept, outcome)
    if shading is not None and (folder / "cache").is_dir():
        _rename_new(folder / "cache", Path(shading))
    target = Path(job.folder) / "runs" / job.id
    if inputs.is_own_folder(target) and not _is_done(target):
        target.rename(target.with_name(f"{target.name}.damaged-{secrets.token_hex(4)}"))
    _rename_new(kept, target)


def _is_done(folder: Path) -> bool:
    try:
        return read_record(folder) is not None
    except InvalidInput:
        return False


def _rename_new(source: Path, target: Path) -> None:
    """Another attempt at the same may have been faster."""
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        source.rename(target)
    except OSError:
        if not inputs.is_own_folder(target):
            raise


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""


def _without(text: str, folder: Path) -> str:
    """Folders have other names in each attempt."""
    return text.replace(f"{folder}/", "").replace(str(folder), ".")
