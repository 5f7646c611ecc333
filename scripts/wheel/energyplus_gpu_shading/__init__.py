"""EnergyPlus with a renderer for solar shading, installed as a wheel.

    from energyplus_gpu_shading import prefix
    prefix()        # the folder with `energyplus`, `gpu_shading`, Energy+.idd, ...
"""

from energyplus_gpu_shading.installation import prefix

__all__ = ["prefix"]
