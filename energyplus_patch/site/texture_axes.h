#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "input/perforated_screens.h"
#include "input/screen_maker.h"
#include "site/surroundings.h"

namespace gpu_shading::energyplus {

// How a triangle's texture coordinates lie on it: one affine map. Nothing where they do not span an
// area.
std::optional<TextureAxes> texture_axes(std::array<glm::dvec3, 3> const& corners,
                                        std::array<glm::dvec2, 3> const& texture);

// A screen lies on a mesh as its texture coordinates do, which so have to be there, at right angles
// to one another, and of not too many sizes. Throws Error, naming the screen and the mesh.
void check_textures(Surroundings const& surroundings, PerforatedScreens const& screens);

}  // namespace gpu_shading::energyplus
