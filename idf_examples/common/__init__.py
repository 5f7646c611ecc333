"""Code shared by the generators of large models. Only Python's standard library is used."""

import sys
from pathlib import Path

# shading_runs is in scripts of the sources, and beside the examples of an installation.
_PARENT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(folder) for folder in (_PARENT / "scripts", _PARENT) if (folder / "shading_runs").is_dir()]
