"""Every script for users and developers explains itself, and does nothing else then."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FILES = [path for folder in ("scripts", "scripts/dev", ".ci") for path in sorted((ROOT / folder).iterdir())
         if path.is_file() and os.access(path, os.X_OK)]
SHELL = [path for path in FILES if path.read_bytes().startswith(b"#!/usr/bin/env bash")]
PYTHON = [path for path in FILES if path.read_bytes().startswith(b"#!/usr/bin/env python3") and path.suffix != ".py"]


def test_there_are_scripts():
    assert {"build", "demo", "setup", "test", "build_wheel", "build_deb", "run"} <= {path.name for path in SHELL}
    assert {"compare_shading", "patch_energyplus", "document_pictures"} <= {path.name for path in PYTHON}


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


@pytest.mark.parametrize("script", PYTHON, ids=lambda path: path.name)
def test_python_scripts_print_their_help(script, tmp_path):
    done = subprocess.run([sys.executable, script, "--help"], cwd=tmp_path, capture_output=True, text=True, timeout=20)
    assert (done.returncode, done.stderr) == (0, "")
    assert script.name in done.stdout
    assert not list(tmp_path.iterdir())


def test_the_help_of_studies_needs_no_package(tmp_path):
    """By a Python without packages, and without a build."""
    command = ROOT / "gpu_shading" / "python" / "gpu_shading" / "study" / "__main__.py"
    done = subprocess.run([sys.executable, "-S", "-E", command, "--help"], capture_output=True, text=True, cwd=tmp_path,
                          env={"PATH": os.environ["PATH"]})
    assert done.returncode == 0, done.stderr
    assert "--dry-run" in done.stdout
    assert not list(tmp_path.iterdir())
