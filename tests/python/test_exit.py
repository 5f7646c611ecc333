"""How Python exits while the library is in use."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from shapes import overhang, window

import gpu_shading


def run(program):
    """(exit status, standard output, standard error)"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60,
                          env=os.environ | {"PYTHONPATH": str(Path(gpu_shading.__file__).parents[1])})
    return done.returncode, done.stdout, done.stderr


COMPUTE = {
    "sunlit fractions": "scene.renderer(resolution=1024).sunlit(suns)",
    "rays": "scene.rays().nearest(np.tile([1, 0, 1.5], (1 << 21, 1)), np.tile([0, -1, 3.0], (1 << 21, 1)))",
    "transmittances": "gpu_shading.Screen.image(np.eye(64), 1, 1, thickness=0.5).tau(45)",
}


@pytest.mark.parametrize("what", COMPUTE)
def test_python_exits_while_a_daemon_thread_computes(what):
    """Three times each: the exit must not destroy what the thread uses, nor wait for all of its work."""
    program = f"""
import threading, time
import numpy as np
import gpu_shading
scene = gpu_shading.Scene([{window().tolist()}], [{overhang().tolist()}])
suns = np.random.default_rng(1).uniform([110, 5], [250, 70], (200_000, 2))
started = threading.Event()

def compute():
    while True:
        started.set()
        {COMPUTE[what]}

threading.Thread(target=compute, daemon=True).start()
started.wait()
time.sleep(0.2)
"""
    for _ in range(3):
        assert run(program) == (0, "", "")


def test_a_call_after_the_end_is_refused():
    """By a function that was registered before the package."""
    program = """
import atexit
def late():
    try:
        scene.sunlit([180, 45])
    except gpu_shading.Error as error:
        print(error)
atexit.register(late)
import gpu_shading
scene = gpu_shading.Scene([[[0, 0, 1], [2, 0, 1], [2, 0, 2]]])
scene.sunlit([180, 45])
"""
    assert run(program) == (0, "Python is exiting\n", "")
