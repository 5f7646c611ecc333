"""The library as an installed CMake package: the example, built against nothing else, against closed forms."""

import math
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / os.environ.get("GPU_SHADING_BUILD", "build")


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    if not (BUILD / "gpu_shading" / "libgpu_shading_gl.so").is_file():
        pytest.skip(f"{BUILD} has no library: run scripts/build")
    if "GPU_SHADING_SANITIZE:STRING=\n" not in (BUILD / "CMakeCache.txt").read_text():
        pytest.skip("a build with sanitizers is not installed")
    prefix = tmp_path_factory.mktemp("prefix")
    run("cmake", "--install", BUILD, "--component", "library", "--prefix", prefix)
    return prefix


@pytest.fixture(scope="module")
def example(prefix, tmp_path_factory):
    """Of a copy, so that nothing else of the repository is found."""
    folder = tmp_path_factory.mktemp("example")
    for file in (ROOT / "gpu_shading" / "docs" / "example").iterdir():
        (folder / file.name).write_text(file.read_text())
    build = folder / "build"
    run("cmake", "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Debug",
        "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror")
    run("cmake", "--build", build)
    return build / "shaded_window"


@pytest.mark.parametrize("azimuth, altitude", [(180, 45), (180, 20), (140, 35), (215, 55), (180, 70), (180, 80),
                                               (0, 30)])
def test_the_example_agrees_with_closed_forms(example, azimuth, altitude):
    """A window 1 m high, 0.5 m behind the edge of an overhang at its head, and 0.5 m behind a pane."""
    printed = dict(line.split() for line in run(example, str(azimuth), str(altitude)).splitlines())
    away = math.radians(azimuth - 180)
    cosine = math.cos(math.radians(altitude)) * math.cos(away)
    profile = math.tan(math.radians(altitude)) / math.cos(away)
    facing = cosine > 0
    lit = max(0.0, 1 - 0.5 * profile) if facing else 0.0
    assert float(printed["overhang"]) == pytest.approx(lit, abs=1e-3)
    # The pane ends at 3 m: above its shadow the sun is high enough to pass over it.
    behind = min(1.0, max(0.0, 2 - 0.5 * profile)) if facing else 0.0
    transmitted = 1.1 * cosine - 0.4 * cosine**2
    assert float(printed["glass"]) == pytest.approx(behind * transmitted + (facing - behind), abs=1e-3)
    through_the_pane = facing and 1.5 + 0.5 * profile < 3
    assert float(printed["ray"]) == pytest.approx(transmitted if through_the_pane else 1.0, abs=1e-5)


def test_the_example_finds_the_opengl_library(prefix, example):
    """Not beside the program, which is elsewhere, but in the prefix."""
    library = next(prefix.rglob("libgpu_shading_gl.so"))
    done = subprocess.run([example, "180", "45"], capture_output=True, text=True, check=True,
                          env={**os.environ, "LD_DEBUG": "files", "GALLIUM_DRIVER": "llvmpipe"})
    assert f"calling init: {library}" in done.stderr


def test_installed_headers_need_no_others(prefix, tmp_path):
    headers = sorted(path.name for path in (prefix / "include" / "gpu_shading").iterdir())
    assert len(headers) > 20
    source = tmp_path / "headers.cpp"
    source.write_text("".join(f"#include <gpu_shading/{header}>\n" for header in headers))
    run("c++", "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-I", prefix / "include", source)
