"""Screens, transparent shades, moving shades and trees in Honeybee models, and runs with rendered shading.

    from honeybee_gpushading import PerforatedScreen, run
    shade.properties.gpu_shading.screen = PerforatedScreen("Blades", hole_shape="Round", hole_size=0.008, pitch=0.012,
                                                           thickness=0.002)
    run(model, "weather.epw").data("Zone Ideal Loads Supply Air Total Cooling Energy")

Honeybee imports packages whose names begin with honeybee_ and have no other underscore, so that every program that
reads and writes HBJSON with this package installed keeps the properties.
"""

from honeybee_gpushading import _extend_honeybee
from honeybee_gpushading.objects import MovingShade, PerforatedScreen, TransparentShade, Tree
from honeybee_gpushading.simulation import Results, SunHours, run, sun_hours, write_idf
from honeybee_gpushading.writer import model_to_gpu_shading

_extend_honeybee.extend()

__all__ = ["MovingShade", "PerforatedScreen", "Results", "SunHours", "TransparentShade", "Tree",
           "model_to_gpu_shading", "run", "sun_hours", "write_idf"]
