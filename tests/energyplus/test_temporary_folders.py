"""No command leaves temporary folders behind: not when a signal ends it, at any moment, nor where files or descriptors
are limited."""

import os
import random
import resource
import signal
import subprocess
import time

import pytest
from PIL import Image

SCREEN = "GPUShading:PerforatedScreen,Mesh,*Louvre*,Texture,mesh.png,,,,,,0.003;\n"
COMMANDS = {
    "check": ["gpu_shading", "check", "model.idf"],
    "view": ["gpu_shading", "view", "model.idf", "--sun", "180,40", "-o", "view.png"],
    "map": ["gpu_shading", "map", "model.idf", "-w", "weather", "--from", "06-21", "--to", "06-21", "--receivers",
            "South*", "-o", "maps"],
    "screen": ["gpu_shading", "screen", "model.idf", "-o", "screens"],
    "sample": ["gpu_shading", "sample", "model.idf", "-w", "weather", "-o", "samples", "--mode", "coarse"],
    "export": ["gpu_shading", "export", "model.idf", "-w", "weather", "--scheduled", "exported"],
    "run": ["energyplus", "--gpu-shading", "-D", "-w", "weather", "-d", "out", "--gpu-shading-report=report",
            "model.idf"],
    "run with expansion": ["energyplus", "--gpu-shading", "-x", "-D", "-w", "weather", "-d", "out", "model.idf"],
    "run by schedules": ["energyplus", "--gpu-shading-method=scheduled", "-w", "weather", "-d", "out", "model.idf"],
    "run by OpenGL": ["energyplus", "--gpu-shading-method=opengl", "-D", "-w", "weather", "-d", "out", "model.idf"],
}
SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)


def signals_as_usual():
    for each in SIGNALS:
        signal.signal(each, signal.SIG_DFL)


class Command:
    def __init__(self, name, patched, weather, box, folder):
        self.words = [str(weather) if word == "weather" else word for word in COMMANDS[name]]
        self.words[0] = str(patched.parent / self.words[0])
        self.folder = folder
        self.temporary = folder / "temporary"
        self.temporary.mkdir()
        (folder / "model.idf").write_text(box + SCREEN)
        Image.effect_noise((64, 64), 50).save(folder / "mesh.png")

    def start(self, prepare=signals_as_usual):
        # New outputs each time.
        for name in ("view.png", "maps", "screens", "samples", "exported", "out", "report"):
            if (self.folder / name).exists():
                (self.folder / name).rename(self.folder / f"{name} {time.monotonic_ns()}")
        return subprocess.Popen(self.words, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True, preexec_fn=prepare,
                                env=os.environ | {"TMPDIR": str(self.temporary), "GPU_SHADING_DEVICE": "cpu"})

    def left(self):
        return [*self.temporary.iterdir(), *self.folder.rglob(".gpu_shading-*")]


@pytest.fixture
def command(request, patched, weather, box, tmp_path):
    return Command(request.param, patched, weather, box, tmp_path)


@pytest.mark.parametrize("command", COMMANDS, indirect=True)
def test_a_signal_leaves_no_folder(command):
    began = time.monotonic()
    whole = command.start()
    assert whole.wait(60) == 0, whole.stderr.read()
    took = time.monotonic() - began
    seed = random.randrange(2 ** 32)
    moments = random.Random(seed)
    ends = []
    for number in range(4):
        process = command.start()
        moment = took * moments.random()
        try:
            process.wait(moment)
        except subprocess.TimeoutExpired:
            process.send_signal(SIGNALS[number % 3])
        process.communicate(timeout=60)
        ends.append(process.returncode)
        assert not command.left(), f"{SIGNALS[number % 3].name} after {moment:.3f} of {took:.3f} s (seed {seed})"
    assert any(ends)


LIMITS = {f"files of {size} kB": (resource.RLIMIT_FSIZE, 1024 * size) for size in (0, 1)} | {
    f"{count} descriptors": (resource.RLIMIT_NOFILE, count) for count in (4, 6, 8, 12, 20)}


@pytest.mark.parametrize("limit", LIMITS)
@pytest.mark.parametrize("command", ["check", "view", "map", "screen", "run"], indirect=True)
def test_a_limit_leaves_no_folder(command, limit):
    kind, number = LIMITS[limit]

    def prepare():
        signals_as_usual()
        resource.setrlimit(kind, (number, number))

    process = command.start(prepare)
    errors = process.communicate(timeout=60)[1]
    assert not command.left()
    if process.returncode == 0:
        return
    # EnergyPlus itself cannot go on without its files.
    if command.words[0].endswith("energyplus") and kind == resource.RLIMIT_FSIZE:
        assert process.returncode in (1, -signal.SIGXFSZ)
    else:
        assert process.returncode == 1 and "gpu_shading: error: " in errors, errors
