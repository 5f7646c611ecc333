"""Penumbra's own tests (github.com/bigladder/penumbra), with Penumbra itself, on our OpenGL: within 0.001 where they
allow 0.01.

GPU_SHADING_PENUMBRA names a folder with its sources: src, include, test/penumbra_test.cpp, and in vendor the libraries
that it comes with (courierr, glad, glfw, libtess2), as EnergyPlus's own sources have them in third_party/penumbra,
without the tests.
"""

import os
import re
import subprocess
from pathlib import Path

import pytest
import windows
from shading_runs import energyplus

OWN = Path(__file__).resolve().parent / "penumbra"
TOOLCHAIN = energyplus.REPOSITORY / "scripts" / "packaging" / "windows" / "mingw.cmake"
TESTS = 8


@pytest.fixture(scope="module")
def sources():
    folder = os.environ.get("GPU_SHADING_PENUMBRA")
    if not folder:
        pytest.skip("GPU_SHADING_PENUMBRA does not name a folder with Penumbra's sources")
    folder = Path(folder).resolve()
    for part in ("test/penumbra_test.cpp", "src/penumbra.cpp", "vendor/glfw/CMakeLists.txt",
                 "vendor/libtess2/Include/tesselator.h", "vendor/courierr/include/courierr/courierr.h"):
        if not (folder / part).is_file():
            pytest.skip(f"{folder} has no {part}")
    return folder


def build(sources, folder, *options):
    for command in (["cmake", "-G", "Ninja", "-S", OWN, "-B", folder, f"-DPENUMBRA={sources}", *options],
                    ["cmake", "--build", folder, "-j2"]):
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, (done.stdout + done.stderr)[-4000:]


def expect_all_passed(done):
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-2000:]
    assert "SKIPPED" not in done.stdout
    assert int(re.search(r"\[  PASSED  \] (\d+) tests", done.stdout)[1]) >= TESTS


def test_on_linux(sources, tmp_path):
    library = energyplus.build_folder() / "tests" / "energyplus_patch" / "libopengl_redirection.so"
    if not library.is_file():
        pytest.skip(f"{library} is missing: run scripts/build")
    build(sources, tmp_path)
    expect_all_passed(subprocess.run([tmp_path / "penumbra_tests", library], capture_output=True, text=True,
                                     env=os.environ | {"GPU_SHADING_ERROR": "0.0001"}))


def test_on_windows(sources, tmp_path):
    if why := windows.why_not():
        pytest.skip(why)
    dependencies = windows.build_folder() / "dependencies"
    build(sources, tmp_path / "build", f"-DCMAKE_TOOLCHAIN_FILE={TOOLCHAIN}",
          f"-DGPU_SHADING_WINDOWS_DEPENDENCIES={dependencies}")
    library = windows.build_folder() / "energyplus_patch" / "opengl32.dll"
    os.symlink(library, tmp_path / "build" / "opengl32.dll")
    wine = windows.Wine(tmp_path / "wine")
    expect_all_passed(wine.run([tmp_path / "build" / "penumbra_tests.exe"], GPU_SHADING_ERROR="0.0001"))
