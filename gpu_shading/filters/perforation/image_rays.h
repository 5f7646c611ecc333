#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "filters/perforation/image_cells.h"
#include "filters/perforation/sheet_in_beam.h"
#include "filters/perforation/tile_positions.h"
#include "gpu_shading/opacity_tile.h"

namespace gpu_shading {

// Interpolates between two values. Unlike glm::mix, a (1 - part) + b part, it is exact if they are
// equal.
inline float mix(float a, float b, float part) { return a + part * (b - a); }

// The opacity of a tile's image, and the transmittance of its layers, ray by ray on the CPU.
// Positions are in the sheet's plane, m.
class ImageRays {
 public:
  // `parts`: the fractions of the path at which layers are. The image must outlive it.
  ImageRays(OpacityTile const& image, SheetInBeam const& sheet, std::vector<double> const& depths);

  // 0 .. 1.
  float solid_at(glm::dvec2 const& place) const;
  // The fraction of a ray that passes all layers, from its position at the inside face.
  float through(glm::dvec2 const& place) const { return through(position(place)); }

  // The same for rays at equal steps from `first`, where the bit of a ray is set in `wanted`.
  using Passed = std::array<float, ImageCells::most>;
  void find_through(glm::dvec2 const& first, glm::dvec2 const& step, std::uint64_t wanted,
                    Passed& passed) const;
  // A bit for each that passes, where opacity is 0 or 1.
  std::uint64_t passing(glm::dvec2 const& first, glm::dvec2 const& step,
                        std::uint64_t wanted) const;

  // For `sheet.cells`.
  std::shared_ptr<ImageCells const> make_cells(ImageBounds const& bounds) const;

 private:
  // Half a texel beyond a place: the texel there and those before it surround the place.
  glm::uvec2 position(glm::dvec2 const& place) const {
    return part_of_tile((place + half_texel_) / tile_);
  }
  float opacity(glm::uvec2 const& position) const;
  float through(glm::uvec2 const& position) const;
  float solid(float opacity) const;
  // What cells tell of the rays that are wanted.
  ImageCells::Known known(TilePositions const& rays, std::uint64_t wanted) const;

  OpacityTile const* image_;
  ImageCells const* cells_;  // may be null
  float threshold_;          // less than 0: none
  glm::dvec2 tile_;
  glm::uvec2 size_;  // texels
  glm::dvec2 half_texel_;
  std::vector<glm::uvec2> layers_;  // from a ray's position at the inside face
};

}  // namespace gpu_shading
