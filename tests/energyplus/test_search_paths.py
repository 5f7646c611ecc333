"""Programs and libraries are looked for beside ours, and never in the current folder."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from elf_files import SYSTEM, loaded_files, needed, search_path, undefined
from shading_runs import energyplus
from test_map import PYRAMID
from test_screens import write_grey_image

HOSTS = Path(__file__).resolve().parent / "hosts"
FORMATS = """
GPUShading:PerforatedScreen,Image,Louvre*,Texture,tile.png,,,,,,0.001;
GPUShading:Geometry,Pyramid,pyramid.obj,m,Z;
"""
OURS = ("libgpu_shading_energyplus.so", "libgpu_shading_gl.so", "libgpu_shading_pictures.so",
        "libenergyplusapi-official.so", "gpu_shading_image_decoder", "gpu_shading_mesh_decoder")
MARKER = """
#include <stdio.h>
#include <unistd.h>
__attribute__((constructor)) static void ran(void) {
  FILE* const file = fopen("%s", "a");
  if (file != NULL) fputs("ran\\n", file);
  _exit(99);
}
int main(void) { return 0; }
"""


@pytest.fixture
def model(box, tmp_path):
    """One that needs everything of ours that is loaded or run."""
    write_grey_image(tmp_path / "tile.png", [[255, 0, 90], [0, 255, 0]])
    (tmp_path / "pyramid.obj").write_text(PYRAMID)
    path = tmp_path / "model.idf"
    path.write_text(box + FORMATS)
    return path


class Foreign:
    """A program and a library, by many names, that leave a trace where they are run."""

    def __init__(self, folder, asked):
        """`asked`: the files of ours whose symbols the library has."""
        self.folder, self.trace = folder, folder / "trace"
        source = folder / "marker.c"
        symbols = sorted(set().union(*map(undefined, asked)))
        source.write_text(MARKER % self.trace + "".join(f"char {name};\n" for name in symbols))
        self.program, self.library = folder / "marker", folder / "marker.so"
        subprocess.run(["cc", "-o", self.program, source], check=True)
        subprocess.run(["cc", "-shared", "-fPIC", "-o", self.library, source], check=True)

    def stand_in_for(self, name):
        path = self.folder / name
        path.unlink(missing_ok=True)
        path.symlink_to(self.library if ".so" in name else self.program)

    def ran(self):
        found = self.trace.exists()
        self.trace.unlink(missing_ok=True)
        return found


@pytest.fixture
def foreign(patched, tmp_path):
    return Foreign(tmp_path, ours_of(patched.parent))


def variables(**more):
    kept = {key: value for key, value in os.environ.items()
            if key not in ("DISPLAY", "LD_LIBRARY_PATH") and not key.startswith("GPU_SHADING")}
    return kept | more


def ours_of(prefix):
    """The files of a patched folder that are not EnergyPlus's."""
    return [path for path in loaded_files(prefix) if not (prefix / path.name).is_symlink()
            and (path.name in ("energyplus", "gpu_shading", "libenergyplusapi.so") or "gpu_shading" in path.name)]


def test_what_is_built_looks_beside_itself(patched):
    build = energyplus.build_folder()
    files = [path for path in loaded_files(build) if "CMakeFiles" not in path.parts] + ours_of(patched.parent)
    assert {path.name for path in files} >= {"libgpu_shading_python.so", "energyplus", "gpu_shading", *OURS[:3]}
    assert [path for path in files if search_path(path) not in ([], ["$ORIGIN"])] == []


def test_energyplus_s_own_files_look_nowhere_relative(official):
    for path in loaded_files(official.parent.resolve()):
        assert all(element.startswith(("/", "$ORIGIN")) for element in search_path(path)), path


def commands(prefix, model, weather):
    run = [prefix / "energyplus", "-D", "-w", weather, "-d"]
    program = prefix / "gpu_shading"
    return {"stock": [*run, "stock", "stock.idf"],
            "shaded": [*run, "shaded", "--gpu-shading", model],
            "check": [program, "check", model],
            "view": [program, "view", model, "--sun", "200,35", "--size", "64", "-o", "view.png"],
            "devices": [program, "devices"],
            "version": [program, "--version"]}


def test_libraries_beside_a_model_are_not_loaded(patched, model, box, weather, foreign):
    """By any name that ours ask for, but the C library's, which the marker needs."""
    (model.parent / "stock.idf").write_text(box)
    todo = commands(patched.parent, model, weather)
    foreign.stand_in_for("libxxhash.so.0")
    subprocess.run(todo["version"], cwd=model.parent, env=variables(LD_LIBRARY_PATH="."), capture_output=True)
    assert foreign.ran(), "the marker leaves no trace where it is loaded"
    asked = set().union(*map(needed, ours_of(patched.parent))) - SYSTEM
    for name in asked | set(OURS) | {"libEGL.so.1", "libGL.so.1"}:
        foreign.stand_in_for(name)
    for name, command in todo.items():
        done = subprocess.run(command, cwd=model.parent, env=variables(), capture_output=True, text=True)
        assert not foreign.ran(), name
        assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("named", ["by a relative path", "by LD_LIBRARY_PATH=."])
@pytest.mark.parametrize("call", ["by GPU_SHADING", "by gpu_shading_install"])
def test_a_host_may_leave_the_folder_by_which_it_loaded_us(named, call, patched, model, weather, tmp_path, foreign):
    for name in OURS:
        foreign.stand_in_for(name)
    folder = "./" if named == "by a relative path" else ""
    installs = call == "by gpu_shading_install"
    environment = {} if folder else {"LD_LIBRARY_PATH": "."}
    module = f"{folder}libgpu_shading_energyplus.so" if installs else ""
    command = [sys.executable, HOSTS / "moving_host.py", f"{folder}libenergyplusapi.so", module, patched.parent,
               tmp_path, "-D", "-w", weather, "-d", tmp_path / "out", model]
    done = subprocess.run(command, cwd=patched.parent, capture_output=True, text=True,
                          env=variables(**environment, GPU_SHADING="" if installs else "1"))
    run = energyplus.Run(done.returncode, done.stdout, done.stderr, tmp_path / "out", 0.0)
    assert not foreign.ran()
    assert run.completed, run.why()
    assert run.method == "PixelCounting" and run.rendering
