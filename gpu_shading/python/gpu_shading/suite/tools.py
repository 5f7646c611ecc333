"""Tools that are scored: a command that gets the file of a scene and prints what it answers."""

from __future__ import annotations

import contextlib
import json
import os
import shlex
import signal
import subprocess
import tempfile
from dataclasses import dataclass

from gpu_shading._text import one_line
from gpu_shading.errors import InvalidInput
from gpu_shading.suite.scenes import Answers, Scene, checked

_MOST_BYTES = 1 << 24


@dataclass(frozen=True)
class Tool:
    name: str
    command: tuple[str, ...]


@dataclass(frozen=True)
class Outcome:
    """Answers, or why there are none."""

    answers: Answers | None
    unsupported: str = ""
    failed: str = ""


def tool_of(argument: str) -> Tool:
    """NAME=COMMAND, or a command alone, which is its own name. Raises InvalidInput."""
    name, equals, command = argument.partition("=")
    try:
        words = shlex.split(command if equals else argument)
    except ValueError as error:
        raise InvalidInput(f"--tool {argument}: {error}") from None
    if not words:
        raise InvalidInput(f"--tool {argument}: expected NAME=COMMAND")
    return Tool(name if equals else argument, tuple(words))


def ask(tool: Tool, scene: Scene, limit: float) -> Outcome:
    """Runs the tool for at most so many seconds."""
    names = [outline.name for outline in scene.outlines if outline.receives]
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        try:
            process = subprocess.Popen([*tool.command, str(scene.path.absolute())], stdin=subprocess.DEVNULL,
                                       stdout=out, stderr=errors, start_new_session=True)
        except OSError as error:
            raise InvalidInput(f"--tool {tool.name}: {tool.command[0]}: {error.strerror}") from None
        try:
            status = process.wait(limit)
        except subprocess.TimeoutExpired:
            return Outcome(None, failed=f"took more than {limit:g} s")
        finally:
            _end(process)
        out.seek(0)
        text = out.read(_MOST_BYTES)
        if status != 0:
            errors.seek(0)
            said = errors.read(_MOST_BYTES).decode(errors="replace").strip().splitlines()
            return Outcome(None, failed=one_line(said[-1]) if said else f"ended with status {status}")
    try:
        answer = json.loads(text)
        if isinstance(answer, dict):
            return Outcome(None, unsupported=one_line(str(answer["not supported"])))
        if len(answer) != len(scene.suns):
            raise ValueError(f"expected {len(scene.suns)} suns")
        return Outcome([checked(values, names) for values in answer])
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        return Outcome(None, failed=one_line(f"printed no answers: {error}"))


def _end(process: subprocess.Popen[bytes]) -> None:
    """With all that it started."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
