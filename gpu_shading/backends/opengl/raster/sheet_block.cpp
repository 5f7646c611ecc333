#include "backends/opengl/raster/sheet_block.h"

#include <algorithm>

namespace gpu_shading {

TextureCells texture_cells(OpacityTile const& tile, int most_texels) {
  int const most = most_texels - 2;
  TextureCells cells;
  cells.columns = std::min(tile.columns(), most);
  cells.rows = std::min(tile.rows(), most);
  cells.across = (tile.columns() + cells.columns - 1) / cells.columns;
  cells.up = (tile.rows() + cells.rows - 1) / cells.rows;
  return cells;
}

void add_block(SheetBlocks& blocks, SheetInBeam const& sheet, PerforatedScreen const& screen,
               int most_texels) {
  SheetBlock& block = blocks.sheets.emplace_back();
  block.normal = glm::vec4(sheet.normal, sheet.inside);
  block.ray = glm::vec4(sheet.way, sheet.outside, sheet.in_place);
  block.tile = glm::vec4(sheet.tile, sheet.blend_from, sheet.blend_to);
  block.hole = {sheet.half_hole, sheet.half_slot, sheet.staggered ? 1.0F : 0.0F, sheet.threshold};
  block.effective = sheet.effective;
  block.kind = {static_cast<int>(sheet.shape), sheet.layers,
                static_cast<int>(blocks.regions.size()), sheet.regions_across};
  block.image.x = sheet.regions_up;
  if (screen.tile()) {
    TextureCells const cells = texture_cells(*screen.tile(), most_texels);
    block.image.y = cells.columns;
    block.image.z = cells.rows;
    block.image.w = cells.across;
    block.texels = {screen.tile()->columns(), screen.tile()->rows(), 0.0F, 0.0F};
  }
  blocks.regions.insert(blocks.regions.end(), sheet.regions.begin(), sheet.regions.end());
}

}  // namespace gpu_shading
