"""The gpu_shading program: devices, and what a model's surfaces will be."""

import os
import re
import signal
import subprocess
import time
from pathlib import Path

import pytest


@pytest.fixture
def program(patched):
    def call(*arguments):
        return subprocess.run([patched.parent / "gpu_shading", *arguments], capture_output=True, text=True)

    return call


def test_devices_lists_what_can_render(program):
    done = program("devices")
    assert done.returncode == 0, done.stderr
    *devices, cpu = done.stdout.splitlines()
    for number, line in enumerate(devices):
        assert line.startswith(f"{number}  ")
        assert "software" in line or "GPU" in line
    assert re.fullmatch(r"cpu  CPU \(\d+ threads?, .*\)", cpu)


def test_check_prints_what_each_surface_will_be(program, courtyard):
    done = program("check", courtyard)
    assert done.returncode == 0, done.stderr
    rows = {line.split("  ")[0]: line for line in done.stdout.splitlines()}
    assert any("Shading:" in line and "opaque" in line for line in rows.values())
    assert any("window or door" in line for line in rows.values())
    assert any("reveal" in line for line in rows.values())
    assert done.stdout.splitlines()[-1].endswith("surfaces")


@pytest.mark.parametrize("text, words", [
    ("Version,25.2;\nGPUShading:Settings,none;\n", ("GPUShading:Settings", "Resolution", "none")),
    ("Version,25.2;\nGPUShading:Nonsense,1;\n", ("GPUShading:Nonsense", "no such object")),
    ("Version,23.1;\n", ("Version Identifier", "23.1", "25.2")),
    ("Version,25.2;\n", ("EnergyPlus does not get as far",)),
])
def test_check_says_what_is_wrong(program, tmp_path, text, words):
    model = tmp_path / "model.idf"
    model.write_text(text)
    done = program("check", model)
    assert done.returncode == 1
    assert done.stderr.startswith("gpu_shading: error: ")
    for word in words:
        assert word in done.stderr


def test_check_of_a_missing_file(program, tmp_path):
    done = program("check", tmp_path / "missing.idf")
    assert done.returncode == 1
    assert "missing.idf: no such file" in done.stderr


class Started:
    """gpu_shading check, with EnergyPlus running."""

    def __init__(self, patched, model, folder):
        self.folder = folder  # of temporary files
        self.process = subprocess.Popen([patched.parent / "gpu_shading", "check", model], text=True,
                                        stderr=subprocess.PIPE, stdout=subprocess.PIPE,
                                        env={**os.environ, "TMPDIR": str(folder)})
        children = Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children")
        limit = time.monotonic() + 30.0
        while not (found := children.read_text().split()):
            assert self.process.poll() is None and time.monotonic() < limit
            time.sleep(0.001)
        self.energyplus = int(found[0])

    def finish(self):
        """Exit status and what it printed."""
        output, errors = self.process.communicate(timeout=60)
        assert not list(self.folder.iterdir())
        with pytest.raises(ProcessLookupError):
            os.kill(self.energyplus, 0)
        return self.process.returncode, output, errors


@pytest.fixture
def started(patched, courtyard, tmp_path):
    (tmp_path / "temporary").mkdir()
    return Started(patched, courtyard, tmp_path / "temporary")


def test_a_crash_of_energyplus_is_one_error(started):
    os.kill(started.energyplus, signal.SIGSEGV)
    status, output, errors = started.finish()
    assert (status, output) == (1, "")
    assert errors.startswith("gpu_shading: error: ") and len(errors.splitlines()) == 1
    assert "ended by signal 11" in errors


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_an_interrupted_program_takes_energyplus_along(started, sent):
    started.process.send_signal(sent)
    assert started.finish() == (-sent, "", "")
