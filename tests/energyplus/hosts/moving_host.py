#!/usr/bin/env python3
"""A Python program that loads EnergyPlus's library by a relative name, and works in another folder.

    moving_host.py LIBRARY MODULE PREFIX FOLDER [EnergyPlus's arguments ...]

MODULE is that of GPU shading, on which gpu_shading_install is then called, or "".
"""

import ctypes
import os
import sys
from pathlib import Path

import host


def main():
    library, module, prefix, folder, *arguments = sys.argv[1:]
    energyplus = ctypes.CDLL(library, mode=ctypes.RTLD_LOCAL)
    gpu_shading = ctypes.CDLL(module, mode=ctypes.RTLD_LOCAL) if module else None
    os.chdir(folder)
    if gpu_shading and gpu_shading.gpu_shading_install(None, 0, None) != 0:
        gpu_shading.gpu_shading_message.restype = ctypes.c_char_p
        print(gpu_shading.gpu_shading_message().decode(), file=sys.stderr)
        return 1
    return host.run(energyplus, Path(prefix), arguments)


if __name__ == "__main__":
    sys.exit(main())
