#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "filters/perforation/tile_positions.h"
#include "gpu_shading/opacity_tile.h"

namespace gpu_shading {

// Where an image is open and where it is solid: a lattice of cells, `per_texel` to each side of a
// texel, with bits that bound the opacity in a cell and those to the right of it, above and both.
struct ImageBounds {
  explicit ImageBounds(OpacityTile const& image);

  int per_texel;  // a power of 2
  int columns;    // of cells
  int rows;
  std::size_t stride;                      // words of a row, which has its columns twice
  std::vector<std::uint64_t> some_solid;   // opacity may be above the threshold, or above 0
  std::vector<std::uint64_t> every_solid;  // it is above the threshold everywhere, or is 1
};

// Which rays of one sun direction pass all layers of an image or are stopped by one, for all that
// pass the inside face in the same cell.
class ImageCells {
 public:
  // `layers`: displacements of the layers from a ray's position at the inside face, in texels, from
  // 0 to the image's columns and rows.
  ImageCells(ImageBounds const& bounds, std::span<glm::dvec2 const> layers);

  // Whether so many rays are worth the cells.
  static bool worth(OpacityTile const& image, double rays);

  // For rays from half a texel beyond their positions, as cells begin at the centres of texels; a
  // bit for each, the lowest for the first. Neither is set where rays of the same cell differ, or
  // near the edge of a cell.
  static constexpr std::size_t most = 64;
  struct Known {
    std::uint64_t open;
    std::uint64_t solid;
  };
  Known find(TilePositions const& rays) const;

 private:
  glm::uvec2 cells_;        // of the image's sides
  std::size_t stride_ = 0;  // words of a row
  // Of 32 cells each: bits of the open ones, and then of the solid ones. The last has none.
  std::vector<std::uint64_t> words_;
};

}  // namespace gpu_shading
