"""Files that are written as a whole or not at all, as energyplus_patch/platform/staged_files.h does in C++."""

from __future__ import annotations

import contextlib
import fcntl
import os
import re
import secrets
import shutil
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import NoReturn

from gpu_shading.errors import FileError

# These three are those of held_folder.h, so that each language deletes what the other's killed processes left.
_PREFIX = ".gpu_shading-"
_LOCK = ".lock"
_MARK = b"gpu_shading: temporary, deleted when its process has ended\n"


def write_whole(path: str | os.PathLike[str], content: str | bytes) -> None:
    """Writes or replaces a file, text as UTF-8. Errors as `staged` has them."""
    with staged(path) as temporary:
        temporary.write_bytes(content.encode() if isinstance(content, str) else content)


@contextlib.contextmanager
def staged(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yields where to write the file `path`: under the same name in a private folder beside it. At the end of the block
    it is flushed to disk and renamed; after an error everything is as before.

    More files may be written beside the yielded path. They go beside `path` first, and meanwhile there is no file
    `path`, so that one that lists the others never lists a mixture of old and new.

    Raises FileError, "PATH: cannot be written (why)": the disk is full, the folder does not exist, or the name is taken
    by a link, folder, pipe or device, none of which is replaced.
    """
    wanted = Path(path)
    _require_replaceable(wanted)
    try:
        with private_folder(wanted.parent) as folder:
            yield folder / wanted.name
            _put_in_place(folder, wanted)
    except FileError:
        raise
    except OSError as error:
        # An error with another file's name is about that file.
        named = os.fsdecode(error.filename) if error.filename is not None else ""
        if named not in ("", str(wanted.parent)) and _PREFIX not in named:
            raise
        _fail(wanted, error.strerror or str(error))


def _fail(path: Path, why: str) -> NoReturn:
    raise FileError(f"{path}: cannot be written ({why})") from None


def _require_replaceable(path: Path) -> None:
    if path.name in ("", "..", _LOCK):
        _fail(path, "it is not the name of a file")
    try:
        mode = path.lstat().st_mode
    except FileNotFoundError:
        return
    except (OSError, ValueError) as error:
        _fail(path, getattr(error, "strerror", None) or str(error))
    if stat.S_ISLNK(mode):
        _fail(path, "it is a link: give the file itself")
    if not stat.S_ISREG(mode):
        _fail(path, "it is a folder" if stat.S_ISDIR(mode) else "it is not a file")


def _put_in_place(folder: Path, wanted: Path) -> None:
    others = [entry.name for entry in sorted(folder.iterdir()) if entry.name not in (wanted.name, _LOCK)]
    for name in (*others, wanted.name):
        _flush(folder / name, os.O_RDONLY)
        _require_replaceable(wanted.with_name(name))
    if others:
        wanted.unlink(missing_ok=True)
    for name in (*others, wanted.name):
        (folder / name).replace(wanted.with_name(name))
    _flush(wanted.parent, os.O_RDONLY | os.O_DIRECTORY)


def _flush(path: Path, flags: int) -> None:
    descriptor = os.open(path, flags)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


@contextlib.contextmanager
def private_folder(parent: Path) -> Iterator[Path]:
    """A new folder that only this user may enter, deleted at the end. Its locked file says that its process lives; what
    killed processes left in `parent` is deleted."""
    with contextlib.suppress(OSError):
        for entry in os.listdir(parent):
            if re.fullmatch(re.escape(_PREFIX) + "[0-9a-f]{8}", entry):
                _delete_if_abandoned(parent / entry)
    folder = parent / f"{_PREFIX}{secrets.token_hex(4)}"
    folder.mkdir(0o700)
    try:
        with open(folder / _LOCK, "xb", buffering=0) as lock:
            # File systems without locks will do: then nobody cleans up. The mark comes last, so that nobody takes the
            # folder for abandoned before it is locked.
            with contextlib.suppress(OSError):
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            lock.write(_MARK)
            yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _delete_if_abandoned(folder: Path) -> None:
    with contextlib.suppress(OSError):
        found = folder.lstat()
        if not stat.S_ISDIR(found.st_mode) or found.st_uid != os.geteuid():
            return
        with open(os.open(folder / _LOCK, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as lock:
            if lock.read(len(_MARK) + 1) == _MARK:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder, ignore_errors=True)
