"""Runs the programs of the patched folder."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Sequence
from pathlib import Path

from gpu_shading import _places
from gpu_shading.errors import InvalidInput, RunError

Name = str | os.PathLike[str]


def file(name: Name, what: str) -> Path:
    """The absolute path of a file that must be there."""
    path = Path(name)
    if not path.is_file():
        raise InvalidInput(f"{what}: {path}: no such file")
    return path.absolute()


def gpu_shading(arguments: Sequence[str | Path]) -> str:
    """What the gpu_shading program prints. Raises RunError with its message."""
    done = subprocess.run([_places.prefix() / "gpu_shading", *arguments], capture_output=True,
                          stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        raise RunError(last_message(done.stderr.decode(errors="replace"), "gpu_shading", done.returncode))
    return done.stdout.decode(errors="replace")


def last_message(text: str, program: str, status: int) -> str:
    """The last error among a program's lines."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    errors = [line for line in lines if re.search(r"\berror: ", line)] or lines
    return re.sub(r"^gpu_shading: error: ", "", errors[-1]) if errors else f"{program}: exit status {status}"
