"""The version of this software, for --version of each script. Only Python's standard library is used."""

import re
from pathlib import Path

_HERE = Path(__file__).resolve().parent


def version():
    """As CMakeLists.txt has it; an installation has a copy."""
    installed = _HERE.parent / "VERSION"
    if installed.is_file():
        return installed.read_text().strip()
    return re.search(r"project\(gpu_shading VERSION ([\d.]+)", (_HERE.parents[1] / "CMakeLists.txt").read_text())[1]


def add_version(parser):
    """Adds --version."""
    parser.add_argument("--version", action="version", version=f"%(prog)s {version()}")
