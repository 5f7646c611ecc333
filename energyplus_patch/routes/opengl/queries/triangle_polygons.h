#pragma once

#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gpu_shading/polygon.h"

namespace gpu_shading::energyplus {

// Vertices that are drawn together: the triangles of one surface.
struct DrawnRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  std::uint32_t end() const { return first + count; }
  auto operator<=>(DrawnRange const&) const = default;  // NOLINT(modernize-use-nullptr)
};

// The polygons that triangles were made of: their outlines and holes, and more than one if the
// triangles are not connected. Vertices are compared exactly; triangles run counterclockwise as
// seen from outside, and so do the outlines. Ends of three vertices each; a rest is ignored.
std::vector<Polygon> polygons_of(std::span<glm::vec3 const> triangles);

}  // namespace gpu_shading::energyplus
