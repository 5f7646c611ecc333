#!/usr/bin/env python3
"""A Python program that runs EnergyPlus through its Python API and knows nothing of GPU shading.

    plain_host.py PREFIX [EnergyPlus's arguments ...]

PREFIX holds the package pyenergyplus.
"""

import sys


def main():
    sys.path.insert(0, sys.argv[1])
    from pyenergyplus.api import EnergyPlusAPI

    api = EnergyPlusAPI()
    state = api.state_manager.new_state()
    return api.runtime.run_energyplus(state, sys.argv[2:])


if __name__ == "__main__":
    sys.exit(main())
