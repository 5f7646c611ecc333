"""The Python package, from the sources and the build. It skips, saying so, without the library of scripts/build."""

import os
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
TOOLS = REPOSITORY / ".venv" / "tools"
sys.path.insert(0, str(REPOSITORY / "gpu_shading" / "python"))
# After what .venv has itself.
sys.path.append(str(TOOLS))

library = REPOSITORY / os.environ.get("GPU_SHADING_BUILD", "build") / "gpu_shading" / "libgpu_shading_python.so"


def pytest_ignore_collect(collection_path):
    """Modules import the package at their beginning."""
    if collection_path.name.startswith("test_") and not library.is_file():
        return True
    return None


def pytest_report_header():
    return None if library.is_file() else f"skipped: {library} is missing: run scripts/build"


@pytest.fixture(scope="session")
def shapely():
    return pytest.importorskip("shapely", reason=f"{TOOLS} has no shapely: run scripts/setup")
