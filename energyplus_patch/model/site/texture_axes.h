#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "model/input/perforated_screens.h"
#include "model/input/screen_maker.h"
#include "model/site/surroundings.h"

namespace gpu_shading::energyplus {

// The affine map from a triangle's plane to its texture coordinates. Empty if they do not span an
// area.
std::optional<TextureAxes> texture_axes(std::array<glm::dvec3, 3> const& corners,
                                        std::array<glm::dvec2, 3> const& texture);

// Checks the texture coordinates that place a screen on a mesh: they must exist, be at right angles
// to one another, and not have too many sizes. Throws Error, naming the screen and the mesh.
void check_textures(Surroundings const& surroundings, PerforatedScreens const& screens);

}  // namespace gpu_shading::energyplus
