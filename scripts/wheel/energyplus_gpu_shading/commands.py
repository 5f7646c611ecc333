"""The commands of the wheel. Each hands over to the program or script of the same name."""

import os
import sys

from energyplus_gpu_shading.installation import PACKAGE, SCRIPTS, official, prefix


def _become(program, *arguments):
    os.execv(program, [str(program), *arguments])


def run_energyplus():
    """EnergyPlus, with --gpu-shading. Asked for the version, it says that of both."""
    arguments = sys.argv[1:]
    if {"-v", "--version"} & set(arguments) and not any(word.startswith("--gpu-shading") for word in arguments):
        arguments.append("--gpu-shading")
    _become(prefix() / "energyplus", *arguments)


def run_gpu_shading():
    if sys.argv[1:2] == ["study"]:
        os.environ.setdefault("GPU_SHADING_PREFIX", str(prefix()))
        _become(sys.executable, str(PACKAGE.parent / "gpu_shading" / "study" / "__main__.py"), *sys.argv[2:])
    _become(prefix() / "gpu_shading", *sys.argv[1:])


def run_patch_energyplus():
    _become(sys.executable, str(SCRIPTS / "patch_energyplus"), *sys.argv[1:])


def run_compare_shading():
    os.environ.setdefault("GPU_SHADING_PREFIX", str(prefix()))
    os.environ.setdefault("GPU_SHADING_OFFICIAL", str(official()))
    _become(sys.executable, str(SCRIPTS / "compare_shading"), *sys.argv[1:])
