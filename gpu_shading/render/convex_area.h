#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

namespace gpu_shading {

// A limit of an area in each row of pixels: x at the middle of row 0, and how it changes by row.
struct RowLimit {
  float start = 0.0F;
  float slope = 0.0F;
};

// A convex area of a tile: in each of its rows, from the greatest of its left limits to the least
// of its right ones. Areas with an edge in common have the same limit there to the bit, so that
// each pixel is in one of them.
struct ConvexArea {
  static constexpr std::size_t most_limits = 5;  // of four edges and a cut

  int first_row = 0;
  int end_row = 0;
  std::size_t limits = 0;  // of the side that has more; the rest has no effect
  std::array<RowLimit, most_limits> left{};
  std::array<RowLimit, most_limits> right{};
};

// The area of the parallelogram that two edges span, positive where the second lies anticlockwise
// of the first.
inline double cross(glm::dvec2 const& a, glm::dvec2 const& b) { return a.x * b.y - a.y * b.x; }

// Of three or four corners, in pixels of a tile of `side`, either way round.
ConvexArea area_within(std::span<glm::dvec2 const> corners, int side);

// The same, of what is in front of a plane: where the distance from it, of each corner here, is
// more than 0.
ConvexArea area_in_front(std::span<glm::dvec2 const> corners, std::span<double const> distances,
                         int side);

// The pixels of an area whose middles are in it, by row.
struct RowSpans {
  static constexpr int rows = 64;  // few enough to stay in the nearest cache

  std::array<std::int32_t, rows> first;
  std::array<std::int32_t, rows> length;
  std::int32_t longest;
};

// Those of rows from `first_row` on, as if the area had them all.
void find_spans(ConvexArea const& area, int first_row, int side, RowSpans& spans);

}  // namespace gpu_shading
