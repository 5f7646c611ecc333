"""Every program and library of ours is built with the protections that distributions build theirs with."""

import re
import subprocess
import zipfile

import pytest
from elf_files import loaded_files
from shading_runs import energyplus
from test_search_paths import ours_of
from test_wheel import WHEELS

PROGRAMS = {"energyplus", "gpu_shading", "gpu_shading_image_decoder", "gpu_shading_mesh_decoder"}
# Others may call no function that has a checked variant.
CHECKED = {"energyplus", "gpu_shading", "libgpu_shading_energyplus.so"}


def readelf(path, *options):
    return subprocess.run(["readelf", "-W", *options, path], capture_output=True, text=True, check=True).stdout


def lacking(path):
    """The protections that a file lacks."""
    headers, dynamic, symbols = readelf(path, "-lh"), readelf(path, "-d"), readelf(path, "--dyn-syms")
    stack = re.search(r"GNU_STACK.* (RWE?) ", headers)
    has = {
        "position-independent": bool(re.search(r"Type:\s+DYN", headers)),
        "a program marked as position-independent": path.name not in PROGRAMS or "PIE" in dynamic,
        "read-only relocations": "GNU_RELRO" in headers,
        "bound when loaded": bool(re.search(r"BIND_NOW|Flags:.*NOW", dynamic)),
        "no executable stack": bool(stack) and stack[1] == "RW",
        # A small library may call nothing that has a checked variant.
        "stack protector": "__stack_chk_fail" in symbols or path.stat().st_size < 100_000,
        "checked functions of the C library": path.name not in CHECKED or "_chk@GLIBC" in symbols,
    }
    return [name for name, found in has.items() if not found]


def test_what_is_installed_is_hardened(patched):
    files = ours_of(patched.parent)
    assert {path.name for path in files} >= PROGRAMS
    files += [energyplus.build_folder() / "gpu_shading" / "libgpu_shading_python.so"]
    assert {path.name: lacking(path) for path in files if lacking(path)} == {}


def test_what_is_in_the_wheel_is_hardened(tmp_path):
    wheels = sorted(WHEELS.glob("energyplus_gpu_shading-*.whl"))
    if not wheels:
        pytest.skip(f"{WHEELS} has no wheel: run scripts/dev/build_wheel")
    with zipfile.ZipFile(wheels[-1]) as archive:
        archive.extractall(tmp_path)
    files = [path for path in loaded_files(tmp_path)
             if path.name in PROGRAMS or path.name.startswith(("libgpu_shading", "libenergyplusapi.so"))]
    assert {path.name for path in files} >= PROGRAMS
    assert {path.name: lacking(path) for path in files if lacking(path)} == {}
