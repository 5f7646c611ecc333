"""Crowns of trees."""

from __future__ import annotations

from typing import Any, Literal

from numpy.typing import ArrayLike

from gpu_shading import _library
from gpu_shading._arrays import number, numbers, pointer
from gpu_shading.errors import InvalidInput
from gpu_shading.optics import choice

Shape = Literal["ellipsoid", "cone", "cylinder", "half ellipsoid", "mesh"]
LeafAngles = Literal["spherical", "planophile", "erectophile"]

_SHAPES = ("ellipsoid", "cone", "cylinder", "half ellipsoid", "mesh")
_LEAF_ANGLES = ("spherical", "planophile", "erectophile")
_HIGHEST = 1e4  # m
_DENSEST = 1e3  # m2/m3


class Crown:
    """The crown of a tree, on a surface that is a rectangle: a solid whose plan is the ellipse in the rectangle, and
    which rises `height` (m) from it along its normal. Leaves are at random places, so that the beam passes with
    exp(-G leaf_density x path), G being the projection of leaves at `leaf_angles`, 0.5 for "spherical" ones.

    `leaf_density`: one-sided leaf area over the solid's volume, m2/m3. `wood_density`: half of the area of branches
    over it, which stays when leaves fall. `mesh`, of the shape "mesh": the corners of the triangles of a closed mesh,
    of shape (number, 3, 3), in the cube from -1 to 1 that the box over the rectangle becomes.
    """

    def __init__(self, height: float, leaf_density: float, *, shape: Shape = "ellipsoid",
                 leaf_angles: LeafAngles = "spherical", wood_density: float = 0.0,
                 mesh: ArrayLike | None = None) -> None:
        self.height = number(height, "height", 0.0, _HIGHEST)
        self.leaf_density = number(leaf_density, "leaf_density", 0.0, _DENSEST)
        self.wood_density = number(wood_density, "wood_density", 0.0, _DENSEST)
        self.shape, self.leaf_angles = shape, leaf_angles
        self.mesh = None if mesh is None else numbers(mesh, "mesh")
        if self.mesh is not None and (self.mesh.size == 0 or self.mesh.size % 9 or self.mesh.shape[-1] != 3):
            raise InvalidInput(f"mesh: an array of shape {self.mesh.shape}, expected (number, 3, 3)")
        self.handle = _library.Handle("filter", "filter_crown", choice(shape, _SHAPES, "shape"), self.height,
                                      self.leaf_density, choice(leaf_angles, _LEAF_ANGLES, "leaf_angles"),
                                      self.wood_density, None if self.mesh is None else pointer(self.mesh),
                                      0 if self.mesh is None else self.mesh.size // 9)

    def __reduce__(self) -> tuple[Any, ...]:
        return _made, (self.height, self.leaf_density, self.shape, self.leaf_angles, self.wood_density, self.mesh)


def _made(height: float, leaf_density: float, shape: Shape, leaf_angles: LeafAngles, wood_density: float,
          mesh: ArrayLike | None) -> Crown:
    return Crown(height, leaf_density, shape=shape, leaf_angles=leaf_angles, wood_density=wood_density, mesh=mesh)
