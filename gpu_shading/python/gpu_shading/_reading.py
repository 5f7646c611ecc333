"""Files that may be damaged: each is read as it was written, or refused by one line."""

from __future__ import annotations

import contextlib
import csv
import sqlite3
import tokenize
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gpu_shading._arrays import Floats
from gpu_shading._text import escaped
from gpu_shading.errors import Error, InvalidInput

_LONGEST = 200  # characters of a reason


@contextlib.contextmanager
def reading(path: Path, kind: str) -> Iterator[None]:
    """Makes the errors of what reads `path`, and those of Python for contents of another form, an InvalidInput:
    "PATH: is not KIND: why"."""
    try:
        yield
    except Error as error:
        if str(error).startswith(escaped(str(path))):
            raise
        raise _refusal(path, kind, error) from None
    except OSError as error:
        raise InvalidInput(f"{error.filename or path}: {error.strerror or error}") from None
    except KeyError as error:
        raise _refusal(path, kind, f"{error.args[0]} is missing") from None
    except (AttributeError, IndexError, TypeError):
        raise _refusal(path, kind, "something is missing, or of another kind") from None
    except (ArithmeticError, EOFError, RecursionError, SyntaxError, ValueError, csv.Error, sqlite3.Error,
            tokenize.TokenError) as error:
        raise _refusal(path, kind, error) from None


def _refusal(path: Path, kind: str, why: object) -> InvalidInput:
    return InvalidInput(f"{path}: is not {kind}: {str(why)[:_LONGEST]}")


def regular(path: Path) -> Path:
    """Refuses what is no file, such as a pipe, which opening would wait for."""
    if not path.is_file():
        raise InvalidInput(f"{path}: {'is not a file' if path.exists() else 'no such file'}")
    return path


def text_of(path: Path) -> str:
    return regular(path).read_text(encoding="utf-8")


def rows_of(path: Path) -> list[dict[str, str]]:
    """The rows of a table, each with all of its columns."""
    with open(regular(path), newline="", encoding="utf-8", errors="replace") as lines:
        rows = list(csv.DictReader(lines, strict=True))
    for number, row in enumerate(rows, 2):
        if None in row or None in row.values():
            raise InvalidInput(f"{path}, line {number}: has another number of columns than the first")
    return rows


def array_of(path: Path) -> NDArray[Any]:
    """An array of a .npy file, without Python objects, and no larger than the file says."""
    return np.array(np.lib.format.open_memmap(regular(path), mode="r"))


def shares(values: Any, what: str, most: float = 1.0) -> Floats:
    """Numbers from 0 to `most`."""
    array = np.asarray(values, dtype=np.float64)
    if not ((array >= 0.0) & (array <= most)).all():  # which nan is not
        raise ValueError(f"{what}: expected 0 to {most:g}")
    return array
