"""Stages of the scripts, on a terminal and elsewhere."""

import io
import time

import pytest
from shading_runs import progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_elsewhere_a_stage_is_one_line():
    stream = io.StringIO()
    with progress.stage("running GPU", stream):
        pass
    assert stream.getvalue().endswith(": running GPU\n") and stream.getvalue().count("\n") == 1


def test_a_terminal_shows_a_long_stage_alone_and_is_left_clean():
    stream = Terminal()
    with progress.stage("short", stream, patience=60):
        pass
    assert stream.getvalue() == "\r\033[K"
    stream = Terminal()
    with progress.stage("long", stream, patience=0.01):
        time.sleep(0.1)
    shown = stream.getvalue()
    assert ": long, 0 s" in shown and shown.endswith("\r\033[K") and "\n" not in shown


def test_an_error_passes():
    with pytest.raises(KeyError), progress.stage("failing", Terminal()):
        raise KeyError
