#pragma once

#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

#include "filters/perforation/sheet_in_beam.h"
#include "gpu_shading/perforated_screen.h"

namespace gpu_shading {

// SheetInBeam in the layout of Sheet in screen.vert, std430.
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

// The data of screens at some directions: one block per screen, direction after direction.
struct SheetBlocks {
  std::vector<SheetBlock> sheets;
  std::vector<glm::vec4> regions;  // of screens whose effective transmittance varies
};

// How the image of a tile is divided into layers of a texture, all of equal size except at the
// ends, each with a border of one texel.
struct TextureCells {
  int columns = 0;  // of a layer, without the border
  int rows = 0;
  int across = 0;  // layers
  int up = 0;
};
TextureCells texture_cells(OpacityTile const& tile, int most_texels);

// `most_texels`: maximum number of texels per side of a texture.
void add_block(SheetBlocks& blocks, SheetInBeam const& sheet, PerforatedScreen const& screen,
               int most_texels);

}  // namespace gpu_shading
