#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "scene/screens.h"

namespace gpu_shading {

// A sheet's kind.x.
enum SheetShape { texture_sheet, round_hole, square_hole, hexagonal_hole };
// Its kind.y in place of a number of layers: nothing passes, and what does is found without layers.
constexpr int solid_sheet = 0;
constexpr int exact_sheet = -1;

// A screen at one direction of the sun: Sheet of screen.vert, std430.
struct SheetBlock {
  glm::vec4 normal{0.0F};
  glm::vec4 ray{0.0F};
  glm::vec4 tile{0.0F};
  glm::vec4 hole{0.0F};
  glm::vec4 effective{0.0F};
  glm::ivec4 kind{0};
  glm::ivec4 image{0};
  glm::vec4 texels{0.0F};
};

// How the image of a tile is cut into layers of a texture: alike but for those at the ends, and
// each with a border of one texel.
struct TextureCells {
  int columns = 0;  // of a layer, without the border
  int rows = 0;
  int across = 0;  // layers
  int up = 0;
};
TextureCells texture_cells(OpacityTile const& tile, int most_texels);

// Whether the effective transmittance is another from region to region. Takes the screen's table.
bool varies(PerforatedScreen const& screen);

// Whether pixels of this area across the beam, m2, may see a screen's effect. Where none do, its
// table is not made.
bool may_see_effect(PerforatedScreen const& screen, glm::dvec3 const& normal,
                    glm::dvec3 const& towards_sun, double pixel_area);

// What the screens of a scene are to the sun at one direction: each entry right for those asked
// for, nothing for the others.
struct ScreenView {
  std::vector<SheetBlock> sheets;
  std::vector<glm::vec4> regions;  // of those whose effective transmittance varies
};

// `numbers`: of the screens in view. `by_effect`: by screen, whether a view may see its effect;
// none where too short. `deployments`: shares in place, 1 where too few.
ScreenView see_screens(Screens const& screens, std::span<int const> numbers,
                       std::vector<bool> const& by_effect, glm::dvec3 const& towards_sun,
                       std::span<double const> deployments, int most_texels);

}  // namespace gpu_shading
