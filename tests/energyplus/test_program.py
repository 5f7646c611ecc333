"""The gpu_shading program: devices, and what a model's surfaces will be."""

import subprocess

import pytest


@pytest.fixture
def program(patched):
    def call(*arguments):
        return subprocess.run([patched.parent / "gpu_shading", *arguments], capture_output=True, text=True)

    return call


def test_devices_lists_what_can_render(program):
    done = program("devices")
    assert done.returncode == 0, done.stderr
    first = done.stdout.splitlines()[0]
    assert first.startswith("0  ")
    assert "software" in first or "GPU" in first


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
