"""Every script for users and developers explains itself, and does nothing else then."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
SHELL = [path for path in sorted((*SCRIPTS.iterdir(), *(SCRIPTS / "dev").iterdir()))
         if path.is_file() and path.read_bytes().startswith(b"#!/usr/bin/env bash")]


def test_there_are_scripts():
    assert {"build", "demo", "setup", "test", "build_wheel", "build_deb"} <= {path.name for path in SHELL}


@pytest.mark.parametrize("flag", ["-h", "--help"])
@pytest.mark.parametrize("script", SHELL, ids=lambda path: path.name)
def test_shell_scripts_print_their_comment(script, flag, tmp_path):
    # Without any other program, nothing else could be done.
    for name in ("bash", "sed"):
        (tmp_path / name).symlink_to(shutil.which(name))
    done = subprocess.run([shutil.which("bash"), script, flag], env={"PATH": str(tmp_path)}, cwd=tmp_path,
                          capture_output=True, text=True)
    comment = [line.removeprefix("#").removeprefix(" ")
               for line in script.read_text().partition("\nset ")[0].splitlines()[1:]]
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines() == comment and len(comment) > 1


def test_the_help_of_studies_needs_no_package(tmp_path):
    """By a Python without packages, and without a build."""
    command = SCRIPTS.parent / "gpu_shading" / "python" / "gpu_shading" / "study" / "__main__.py"
    done = subprocess.run([sys.executable, "-S", "-E", command, "--help"], capture_output=True, text=True, cwd=tmp_path,
                          env={"PATH": os.environ["PATH"]})
    assert done.returncode == 0, done.stderr
    assert "--dry-run" in done.stdout
    assert not list(tmp_path.iterdir())
