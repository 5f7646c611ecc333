"""The versions of this software and of the EnergyPlus that is tested. Only Python's standard library is used."""

import re
from pathlib import Path

_HERE = Path(__file__).resolve().parent


def _stated(file, pattern):
    """As CMakeLists.txt has it; an installation has a copy."""
    installed = _HERE.parent / file
    if installed.is_file():
        return installed.read_text().strip()
    return re.search(pattern + r" ([\d.]+)", (_HERE.parents[1] / "CMakeLists.txt").read_text())[1]


def version():
    """Of this software."""
    return _stated("VERSION", r"project\(gpu_shading VERSION")


def energyplus_release():
    """The EnergyPlus that is tested, such as 9.6.0."""
    return _stated("ENERGYPLUS_RELEASE", r"set\(ENERGYPLUS_RELEASE")


def input_version():
    """What the Version object of a model for this release has."""
    return energyplus_release().rpartition(".")[0]
