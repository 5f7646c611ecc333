"""routes/penumbra/drop_in: the target penumbra in a program of another project, and the patch of EnergyPlus."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / os.environ.get("GPU_SHADING_BUILD", "build")
SOURCE = ROOT / "energyplus_patch" / "routes" / "penumbra" / "drop_in"
ENERGYPLUS = "GPU_SHADING_ENERGYPLUS_SOURCES"

PROGRAM = """\
#include <penumbra/penumbra.h>

int main() {
  Penumbra::Penumbra penumbra(256u);
  const auto wall = penumbra.add_surface(Penumbra::Surface({0, 0, 0, 2, 0, 0, 2, 0, 2, 0, 0, 2}, "Wall"));
  penumbra.add_surface(Penumbra::Surface({-9, -1, 1, 9, -1, 1, 9, -1, 9, -9, -1, 9}, "Screen"));
  penumbra.set_model();
  penumbra.set_sun_position(3.14159265f, 0.0f);
  std::cout << penumbra.calculate_pssa(wall) << std::endl;
  return 0;
}
"""
PROJECT = """\
cmake_minimum_required(VERSION 3.17)
project(consumer LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_EXTENSIONS OFF)
add_compile_options(-Wall -Wextra -Wpedantic -Werror)
add_subdirectory({source} penumbra)
add_executable(consumer main.cpp)
target_link_libraries(consumer PRIVATE penumbra)
"""


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    return done.stdout


def test_a_program_of_another_project_uses_the_target(tmp_path):
    """In C++17, as EnergyPlus is. The sun is level, and what is above one metre is shaded."""
    if not (BUILD / "energyplus_patch" / "libgpu_shading_answers.so").is_file():
        pytest.skip(f"{BUILD} has no libgpu_shading_answers.so: run scripts/build")
    if "GPU_SHADING_SANITIZE:STRING=\n" not in (BUILD / "CMakeCache.txt").read_text():
        pytest.skip("a program without sanitizers cannot load a library with them")
    (tmp_path / "main.cpp").write_text(PROGRAM)
    (tmp_path / "CMakeLists.txt").write_text(PROJECT.format(source=SOURCE))
    run("cmake", "-S", tmp_path, "-B", tmp_path / "build", "-DCMAKE_BUILD_TYPE=Debug", f"-DGPU_SHADING_BUILD={BUILD}")
    run("cmake", "--build", tmp_path / "build")
    assert float(run(tmp_path / "build" / "consumer")) == pytest.approx(2.0, abs=2e-3)


def test_the_library_exports_nothing_else():
    """What it is made of must not take the place of EnergyPlus's own fmt, JSON and others, nor the other way."""
    library = BUILD / "energyplus_patch" / "libgpu_shading_answers.so"
    if not library.is_file():
        pytest.skip(f"{library} is missing: run scripts/build")
    if "GPU_SHADING_SANITIZE:STRING=\n" not in (BUILD / "CMakeCache.txt").read_text():
        pytest.skip("sanitizers export functions of their own")
    lines = run("nm", "-D", "-C", "--defined-only", library).splitlines()
    names = [line.split(" ", 2) for line in lines]
    # V, W and u: inline functions of the standard library and of classes.
    ours = [name for _, kind, name in names if kind in "TDBR"]
    assert ours and all("gpu_shading::answers::" in name for name in ours), ours


@pytest.mark.parametrize("release", ["24.2.0"])
def test_the_patch_applies(release):
    folder = os.environ.get(ENERGYPLUS)
    if not folder:
        pytest.skip(f"{ENERGYPLUS} does not name a folder of EnergyPlus's sources")
    run("git", "apply", "--check", SOURCE / f"energyplus-{release}.patch", cwd=folder)
