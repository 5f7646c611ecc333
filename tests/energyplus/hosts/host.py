#!/usr/bin/env python3
"""A Python program that runs EnergyPlus through its C API, shaded by the GPU.

    host.py PREFIX OPTIONS RUNS [EnergyPlus's arguments ...]

The same as host.c; with the pyenergyplus package of an EnergyPlus installation only the call of
gpu_shading_install is needed, before the first run.
"""

import ctypes
import sys
from pathlib import Path


def install(prefix, options=()):
    """Takes over the shading of the EnergyPlus in prefix, for all runs of this process."""
    # Kept loaded, and local: EnergyPlus carries copies of libraries that Python has from elsewhere.
    energyplus = ctypes.CDLL(str(prefix / "libenergyplusapi.so"), mode=ctypes.RTLD_LOCAL)
    gpu_shading = ctypes.CDLL(str(prefix / "libgpu_shading_energyplus.so"), mode=ctypes.RTLD_LOCAL)
    gpu_shading.gpu_shading_install.argtypes = [ctypes.c_char_p, ctypes.c_int, ctypes.POINTER(ctypes.c_char_p)]
    gpu_shading.gpu_shading_message.restype = ctypes.c_char_p
    words = (ctypes.c_char_p * len(options))(*(word.encode() for word in options))
    if gpu_shading.gpu_shading_install(str(prefix / "libenergyplusapi.so").encode(), len(words), words) != 0:
        raise RuntimeError(gpu_shading.gpu_shading_message().decode())
    return energyplus


def run(energyplus, prefix, arguments):
    """EnergyPlus's exit status."""
    # stateNew would end the interpreter with the state: EnergyPlus takes this Python for its own.
    energyplus.stateNewPython.restype = ctypes.c_void_p
    energyplus.stateDelete.argtypes = [ctypes.c_void_p]
    energyplus.setEnergyPlusRootDirectory.argtypes = [ctypes.c_void_p, ctypes.c_char_p]
    energyplus.energyplus.argtypes = [ctypes.c_void_p, ctypes.c_int, ctypes.POINTER(ctypes.c_char_p)]
    state = energyplus.stateNewPython()
    energyplus.setEnergyPlusRootDirectory(state, str(prefix).encode())
    words = [word.encode() for word in ["energyplus", *arguments]]
    status = energyplus.energyplus(state, len(words), (ctypes.c_char_p * len(words))(*words))
    energyplus.stateDelete(state)
    return status


def main():
    if len(sys.argv) < 4:
        print(__doc__, file=sys.stderr)
        return 2
    prefix, options, runs = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
    try:
        energyplus = install(prefix, options.split())
    except (OSError, RuntimeError) as error:
        print(f"host: {error}", file=sys.stderr)
        return 1
    for _ in range(runs):
        status = run(energyplus, prefix, sys.argv[4:])
        if status != 0:
            return status
    return 0


if __name__ == "__main__":
    sys.exit(main())
