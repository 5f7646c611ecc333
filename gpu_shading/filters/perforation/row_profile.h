#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "filters/perforation/pattern_rays.h"
#include "filters/perforation/sheet_in_beam.h"

namespace gpu_shading {

// The effective transmittance of rows and of columns of a pattern's holes. An edge of the receiver
// that is in line with rows cuts all holes of a row at one place, which the effective transmittance
// of the whole sheet takes no account of. That of rows does, and so does that of columns where
// edges lie across rows; the sum of what both differ from that of the sheet serves all four edges.
class RowProfile {
 public:
  explicit RowProfile(SheetInBeam const& sheet);

  // Transmittance at a position at the inside face, m in the sheet's plane. It can leave 0 .. 1.
  float at(glm::dvec2 const& place) const;
  // The same for many at equal steps from `first`.
  using Passed = PatternRays::Passed;
  void find(glm::dvec2 const& first, glm::dvec2 const& step, Passed& passed) const;

 private:
  static constexpr unsigned steps = 256;  // of a tile
  using Profile = std::array<float, steps>;

  glm::dvec2 tile_;
  // Above the mean, over a tile.
  Profile columns_{};
  Profile rows_{};
  float mean_;
};

}  // namespace gpu_shading
