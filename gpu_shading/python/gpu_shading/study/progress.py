"""One line on a terminal, or a line every half minute elsewhere."""

from __future__ import annotations

import sys
import time

from gpu_shading._text import one_line

_PATIENCE = 30.0  # seconds between lines that are not replaced


def say(text: str) -> None:
    clear = "\r\033[K" if sys.stderr.isatty() else ""
    print(f"{clear}gpu_shading study: {one_line(text)}", file=sys.stderr, flush=True)


class Progress:
    def __init__(self, total: int, done: int) -> None:
        self._total, self._before, self._done, self._failed = total, done, done, 0
        self._began = self._said = time.monotonic()

    def add(self, failed: bool) -> None:
        self._done += 1
        self._failed += failed
        now = time.monotonic()
        self._show(now, f"{self._bar()}{self._line(now)}" if sys.stderr.isatty() else self._line(now))

    def add_check(self, done: int, total: int) -> None:
        """Scenes, before runs begin."""
        if done == total:
            self._began = time.monotonic()
        self._show(time.monotonic(), f"checked {done} of {total} scenes")

    def _show(self, now: float, line: str) -> None:
        if sys.stderr.isatty():
            print(f"\r\033[K{line}", end="", file=sys.stderr, flush=True)
        elif now - self._said > _PATIENCE:
            self._said = now
            say(line)

    def end(self) -> None:
        if sys.stderr.isatty():
            print("\r\033[K", end="", file=sys.stderr)
        say(f"{self._done} of {self._total} runs, {self._failed} failed")

    def _bar(self) -> str:
        width = 20
        filled = width * self._done // max(self._total, 1)
        return f"[{'#' * filled}{'.' * (width - filled)}] "

    def _line(self, now: float) -> str:
        here = self._done - self._before
        left = (now - self._began) / max(here, 1) * (self._total - self._done)
        return f"{self._done} of {self._total} runs, {self._failed} failed, about {in_words(left)} left"


def in_words(seconds: float) -> str:
    """Such as "40 s", "12 min", or "3.5 h"."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
