#pragma once

#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "routes/opengl/queries/triangle_polygons.h"

namespace gpu_shading::energyplus {

// The surfaces that EnergyPlus draws, with the names that they have in `named`, which EnergyPlus
// has listed with vertices to five decimals of a metre. Each is recognised by its vertices; those
// of surfaces in the same place are taken in order. Throws Error if one is none of the named.
std::vector<Surface> name_surfaces(std::span<glm::vec3 const> vertices,
                                   std::span<DrawnRange const> surfaces,
                                   std::vector<Surface> const& named);

}  // namespace gpu_shading::energyplus
