#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "filters/perforation/sheet_in_beam.h"

namespace gpu_shading {

// Rays through the holes of a pattern, ray by ray on the CPU. Positions are in the sheet's plane,
// m.
class PatternRays {
 public:
  explicit PatternRays(SheetInBeam const& sheet);

  bool is_open(glm::dvec2 const& place) const;
  // Whether a ray is in the same hole at a position and at `ray_offset` from there.
  bool passes(glm::dvec2 const& place, glm::dvec2 const& ray_offset) const;

  // The same for many rays at equal steps from `first`: 1 for those that pass, otherwise 0.
  static constexpr int most = 64;
  using Passed = std::array<float, most>;
  void find_passing(glm::dvec2 const& first, glm::dvec2 const& step, glm::dvec2 const& ray_offset,
                    Passed& passed) const;
  // A bit for each, the lowest for the first.
  std::uint64_t passing(glm::dvec2 const& first, glm::dvec2 const& step,
                        glm::dvec2 const& ray_offset) const;

  struct Holes {
    SheetShape shape;
    bool staggered;  // with another hole in the centre of the tile
    float width;     // of the tile, m
    float height;
    float half;      // of a hole's size, m
    float straight;  // half of a slot's straight part, m
  };

 private:
  Holes holes_;
  glm::dvec2 tile_;
};

}  // namespace gpu_shading
