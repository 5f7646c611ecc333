"""Solar shading by rendering: how much of each surface the sun reaches, for any geometry and sun direction.

    import gpu_shading
    scene = gpu_shading.Scene(receivers={"window": window}, casters=[overhang])
    scene.sunlit([[180.0, 45.0]])

Units and axes everywhere: metres; x east, y north, z up; angles in degrees; azimuth clockwise from north, altitude from
the horizon, angles of incidence from the normal. Scenes come from arrays, or from a model of EnergyPlus
(Scene.from_energyplus). `check`, `run`, `sample`, `view`, `map`, `mask`, `modules` and `Study` run EnergyPlus itself.
Errors are subclasses of `Error`.
"""

try:
    import numpy as _numpy  # noqa: F401
except ImportError as _error:
    raise ImportError("gpu_shading needs NumPy: pip install numpy") from _error

from gpu_shading._library import __version__, limit_threads
from gpu_shading._programs import measures, prefix
from gpu_shading.crown import Crown
from gpu_shading.drawings import Drawings, Map, Mask, MaskHour, Picture, Sheet, map, mask, screen, view
from gpu_shading.errors import DeviceError, Error, FileError, InvalidInput, RunError
from gpu_shading.model import check
from gpu_shading.optics import Screen, Transmittance
from gpu_shading.pv import Power, power, write_reductions
from gpu_shading.pv_modules import ModuleField, Modules, modules, read_modules
from gpu_shading.rays import Hits, Rays
from gpu_shading.renderer import Renderer
from gpu_shading.rule import Rule
from gpu_shading.runs import Run, ShadingErrors, Summary, run
from gpu_shading.samples import read_samples, sample, write_samples
from gpu_shading.scene import Scene, Surface
from gpu_shading.study import Case, Study

__all__ = [
    "Case", "Crown", "DeviceError", "Drawings", "Error", "FileError", "Hits", "InvalidInput", "Map", "Mask", "MaskHour",
    "ModuleField", "Modules", "Picture", "Power", "Rays", "Renderer", "Rule", "Run", "RunError", "Scene", "Screen",
    "ShadingErrors", "Sheet", "Study", "Summary", "Surface", "Transmittance", "__version__", "check", "limit_threads",
    "map", "mask", "measures", "modules", "power", "prefix", "read_modules", "read_samples", "run", "sample", "screen",
    "view", "write_reductions", "write_samples",
]
