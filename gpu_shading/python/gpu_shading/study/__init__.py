"""Studies: many runs of EnergyPlus on the workers of Dask, with one table of their results."""

from gpu_shading.study.plan import Case
from gpu_shading.study.study import Study

__all__ = ["Case", "Study"]
