"""Files of users, read within bounds: only regular files, none larger than expected."""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from gpu_shading.errors import InvalidInput

MEBIBYTE = 1 << 20
MAX_MODEL = 256 * MEBIBYTE
MAX_TABLE = 1 << 30
_MAX_FILE = 16 << 30  # of those that are only hashed, such as maps
_BLOCK = 4 * MEBIBYTE


def is_file(path: Path) -> bool:
    """Whether there is a regular file; False for names that no file can have."""
    try:
        return stat.S_ISREG(os.stat(path).st_mode)
    except (OSError, ValueError):
        return False


def is_own_folder(path: Path) -> bool:
    """Whether there is a folder, not a link to one. Raises InvalidInput if there is anything else."""
    try:
        mode = path.lstat().st_mode
    except FileNotFoundError:
        return False
    if not stat.S_ISDIR(mode):
        raise InvalidInput(f"{path}: is {'a link' if stat.S_ISLNK(mode) else 'not a folder'}; expected a folder of "
                           "this study")
    return True


@contextlib.contextmanager
def opened(path: Path, largest: int, follow: bool = True) -> Iterator[BinaryIO]:
    """Without waiting for a pipe's other end. Raises InvalidInput if it is no regular file, or larger than `largest`
    bytes; OSError if it cannot be opened."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC | (0 if follow else os.O_NOFOLLOW))
    except ValueError as error:
        raise InvalidInput(f"{path}: {error}") from None
    try:
        found = os.fstat(descriptor)
        if not stat.S_ISREG(found.st_mode):
            raise InvalidInput(f"{path}: is not a regular file")
        if found.st_size > largest:
            size = f"{largest / MEBIBYTE:.0f} MiB" if largest >= MEBIBYTE else f"{largest} bytes"
            raise InvalidInput(f"{path}: has {found.st_size} bytes; expected at most {size}")
        with open(descriptor, "rb", closefd=False) as file:
            yield file
    finally:
        os.close(descriptor)


def read(path: Path, largest: int, follow: bool = True) -> bytes:
    """As `opened`."""
    with opened(path, largest, follow) as file:
        return file.read(largest)


def side_file(path: Path) -> Path | None:
    """The path, if something is there, which must be a regular file."""
    if not os.path.lexists(path):
        return None
    if not is_file(path):
        raise InvalidInput(f"{path}: is not a regular file; expected extension objects")
    return path


def digest_of(path: Path) -> str:
    """SHA-256, in hexadecimal digits."""
    hashed = hashlib.sha256()
    with opened(path, _MAX_FILE) as file:
        while block := file.read(_BLOCK):
            hashed.update(block)
    return hashed.hexdigest()
