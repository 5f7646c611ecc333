"""How commands of this package begin and end. Imported from its folder, because they say what is missing where the
package itself cannot be imported."""

from __future__ import annotations

import argparse
import importlib.util
import os
import signal
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NoReturn

_PACKAGES = Path(__file__).resolve().parents[1]


class Parser(argparse.ArgumentParser):
    """Of `gpu_shading NAME`; errors are one line."""

    def error(self, message: str) -> NoReturn:
        sys.exit(fail(self.prog, f"{message} (see {self.prog} --help)"))


def fail(program: str, message: str, status: int = 1) -> int:
    """Prints one line, without the package's own functions for it, and returns the status."""
    line = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in " ".join(message.split()))
    if len(line) > 2200:
        line = f"{line[:1200]} ... {line[-800:]}"
    print(f"{program}: {line}", file=sys.stderr)
    return status


def run(program: str, main: str, needs: Sequence[str], work: Callable[[], int], interrupted: str) -> int:
    """Does the work of a command and returns its status; an error is one line. `main`: the command's file. `needs`:
    modules that another Python has if this one lacks them. `interrupted`: what to say then."""
    # Run by path, by a Python that need not know the package; the command's folder must not hide modules of others.
    sys.path = [str(_PACKAGES), *(path for path in sys.path if Path(path or ".").resolve() != Path(main).parent)]
    _use_python_of_sources(main, needs)
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) == signal.SIG_DFL:  # nohup ignores one
            signal.signal(number, _interrupt)
    try:
        from gpu_shading._text import of_error
        from gpu_shading.errors import Error
    except ImportError as error:
        return fail(program, str(error))
    try:
        return work()
    except (Error, ImportError, OSError) as error:
        return fail(program, of_error(error))
    except KeyboardInterrupt as error:
        return fail(program, interrupted, 128 + (error.args[0] if error.args else signal.SIGINT))
    except Exception as error:  # a fault of ours: still one line
        return fail(program, f"{type(error).__name__}: {of_error(error)}; please report this")


def _use_python_of_sources(main: str, needs: Sequence[str]) -> None:
    """scripts/setup puts what is needed into .venv."""
    if all(importlib.util.find_spec(module) for module in needs):
        return
    own = _PACKAGES.parents[1] / ".venv" / "bin" / "python"
    if own.is_file() and Path(sys.prefix) != own.parents[1]:
        os.execv(own, [str(own), main, *sys.argv[1:]])


def _interrupt(number: int, _: object) -> NoReturn:
    raise KeyboardInterrupt(number)
