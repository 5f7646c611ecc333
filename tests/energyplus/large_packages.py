"""Packages that are too large for every machine: scripts/setup --large installs them beside the environment."""

import importlib.util
import os
import sys

import pytest
from shading_runs import energyplus

TOOLS = energyplus.REPOSITORY / ".venv" / "tools"
LARGE = energyplus.REPOSITORY / ".venv" / "large"
sys.path += [folder for folder in (str(TOOLS), str(LARGE)) if folder not in sys.path]


def need(package, large=True):
    """Skips what cannot be tested without a package."""
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is missing: run scripts/setup{' --large' if large else ''}")


def environment(folder, **variables):
    """Of somebody who has these packages, and a home of his own."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith("GPU_SHADING")}
    paths = [os.environ.get("PYTHONPATH", ""), str(energyplus.REPOSITORY / "gpu_shading" / "python"), str(TOOLS),
             str(LARGE)]
    return kept | {"PYTHONPATH": os.pathsep.join(filter(None, paths)), "HOME": str(folder)} | variables
