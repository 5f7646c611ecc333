"""Tells of stages that take long, on standard error."""

import contextlib
import sys
import threading
import time
from pathlib import Path

PATIENCE = 3.0  # seconds until a stage shows on a terminal


@contextlib.contextmanager
def stage(text, stream=None, patience=PATIENCE):
    """While the block runs: on a terminal, a line with its seconds from the third on; elsewhere one line."""
    stream = stream or sys.stderr
    line = f"{Path(sys.argv[0]).name}: {text}"
    if not stream.isatty():
        print(line, file=stream, flush=True)
        yield
        return
    began, ended = time.monotonic(), threading.Event()

    def show():
        wait = patience
        while not ended.wait(wait):
            print(f"\r{line}, {time.monotonic() - began:.0f} s", end="", file=stream, flush=True)
            wait = 1.0

    thread = threading.Thread(target=show, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
        print("\r\033[K", end="", file=stream, flush=True)
