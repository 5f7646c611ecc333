"""Models that a plan names: a file, a folder with all below it, or a pattern with *, ?, [ ] and **."""

from __future__ import annotations

import fnmatch
import itertools
import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from gpu_shading._text import quoted
from gpu_shading.errors import InvalidInput
from gpu_shading.study.inputs import is_file

_MAX_ENTRIES = 1_000_000  # files and folders that are looked at
_IS_PATTERN = re.compile(r"[*?\[]")


def find_models(folder: Path, name: str) -> list[Path]:
    """Sorted; empty if there are none. Each folder is entered once, however many links lead to it. Raises InvalidInput
    if too many files would have to be looked at."""
    path = folder / name
    if is_file(path):
        return [path]
    if os.path.isdir(path):
        base, parts = path, ["**", "*"]
    else:
        fixed = next((i for i, part in enumerate(path.parts) if _IS_PATTERN.search(part)), len(path.parts))
        base, parts = Path(*path.parts[:fixed]), _without_repeats(path.parts[fixed:])
    if not parts:
        return []
    found = set()
    for number, entry in enumerate(_walk(base, parts)):
        if number >= _MAX_ENTRIES:
            raise InvalidInput(f"{quoted(name)} has over {_MAX_ENTRIES:,} files to look at; expected a narrower "
                               "pattern")
        if entry and _is_model(entry.name) and is_file(Path(entry.path)):
            found.add(Path(entry.path))
    return sorted(found)


def _without_repeats(parts: Sequence[str]) -> list[str]:
    """** twice in a row is **, and at the end it is all files below."""
    kept = [part for i, part in enumerate(parts) if part != "**" or parts[i - 1:i] != ("**",)]
    return [*kept, "*"] if kept[-1:] == ["**"] else kept


def _is_model(name: str) -> bool:
    return name.lower().endswith((".idf", ".epjson")) and not name.lower().endswith(".gpu-shading.idf")


def _walk(base: Path, parts: Sequence[str]) -> Iterator[os.DirEntry[str] | None]:
    """Each entry that matches, and None for all else that was looked at."""
    waiting = [(str(base), tuple(parts))]
    seen = set()
    while waiting:
        folder, (part, *rest) = waiting.pop()
        state = _identity(folder), part, len(rest)
        if state in seen:
            continue
        seen.add(state)
        deep = part == "**"
        if deep:
            waiting.append((folder, tuple(rest)))
        for entry in _entries(folder):
            visible = not entry.name.startswith(".") or part.startswith(".")
            matches = visible and (deep or fnmatch.fnmatchcase(entry.name, part))
            yield entry if matches and not rest else None
            if matches and rest and os.path.isdir(entry.path):
                waiting.append((entry.path, (part, *rest) if deep else tuple(rest)))


def _identity(folder: str) -> tuple[int, int] | None:
    try:
        found = os.stat(folder)
        return found.st_dev, found.st_ino
    except (OSError, ValueError):
        return None


def _entries(folder: str) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as entries:
            return sorted(itertools.islice(entries, _MAX_ENTRIES), key=lambda entry: entry.name, reverse=True)
    except (OSError, ValueError):
        return []
