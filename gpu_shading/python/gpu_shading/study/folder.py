"""The folder of a study: only one study at a time works in it, and nothing that others put there is replaced."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import json
import os
import stat
from collections.abc import Iterator, Mapping
from pathlib import Path

from gpu_shading import _files
from gpu_shading.errors import InvalidInput, RunError
from gpu_shading.study import inputs

TABLES = ("runs.csv", "times.csv", "runs.parquet")
_FOLDERS = ("runs", "scenes", "shading")
_WRITTEN = ".gpu_shading_study.json"  # digests of the tables that studies have written
_MAX_WRITTEN = 1 << 16  # bytes


def check(folder: Path) -> None:
    """Raises InvalidInput if the folder has anything under the names of a study's own that no study wrote."""
    for name in _FOLDERS:
        inputs.is_own_folder(folder / name)
    Tables(folder).check()


@contextlib.contextmanager
def occupied(folder: Path) -> Iterator[Path]:
    """Makes the folder if it is missing, and yields one in it for what is temporary. Raises RunError if another study
    works in it."""
    folder.mkdir(parents=True, exist_ok=True)
    with _locked(folder / ".lock"):
        check(folder)
        # What killed workers have left is deleted; those that still run lose their folder, and end.
        with _files.private_folder(folder) as work:
            yield work


@contextlib.contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Nothing is written into the file, which may be anyone's."""
    if path.is_symlink():
        raise RunError(f"{path}: is a link; expected a file of this study")
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o666)
    try:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise RunError(f"{path}: is not a regular file; expected a file of this study")
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise RunError(f"{path.parent}: another study is running in this folder") from None
        yield
    finally:
        os.close(descriptor)


class Tables:
    """The tables in the folder, which are replaced only if a study wrote them, known by their digests."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._written = _read(folder / _WRITTEN)

    def check(self) -> None:
        for name in TABLES:
            path = self._folder / name
            if os.path.lexists(path) and not self._is_ours(path):
                raise InvalidInput(f"{path}: was not written by this study; move it, or choose another folder")

    def write(self, contents: Mapping[str, bytes]) -> None:
        """All that `contents` has, with one that is named runs.csv. Raises as check(), or FileError."""
        self.check()
        for name, content in contents.items():
            # The digest of the table that is there, and first of all that of the one to come: a study that is killed
            # meanwhile knows both.
            self._written[name] = [*self._written.get(name, [])[-1:], hashlib.sha256(content).hexdigest()]
        _files.write_whole(self._folder / _WRITTEN, json.dumps(self._written, indent=1) + "\n")
        with _files.staged(self._folder / "runs.csv") as staged:
            for name, content in contents.items():
                staged.with_name(name).write_bytes(content)

    def _is_ours(self, path: Path) -> bool:
        return not path.is_symlink() and inputs.is_file(path) and (
            inputs.digest_of(path) in self._written.get(path.name, []))


def _read(path: Path) -> dict[str, list[str]]:
    """Of a damaged file nothing, so that no table counts as ours."""
    try:
        read = json.loads(inputs.read(path, _MAX_WRITTEN, follow=False))
        return {name: [str(digest) for digest in read[name]] for name in TABLES if name in read}
    except (OSError, InvalidInput, ValueError, TypeError, KeyError, RecursionError):
        return {}
