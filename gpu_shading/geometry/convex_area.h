#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

namespace gpu_shading {

// A limit of an area in each row of pixels: x at the centre of row 0, and its change per row.
struct RowLimit {
  float start = 0.0F;
  float slope = 0.0F;
};

// A convex area of a tile: each row extends from the largest of its left limits to the smallest of
// its right limits. Areas that share an edge have bitwise the same limit there, so that each pixel
// is in exactly one of them.
struct ConvexArea {
  static constexpr std::size_t max_limits = 5;  // of four edges and a cut

  int first_row = 0;
  int end_row = 0;
  std::size_t limits = 0;  // of the side with more limits; unused ones have no effect
  std::array<RowLimit, max_limits> left{};
  std::array<RowLimit, max_limits> right{};
};

// The area of the parallelogram of two edges, positive if the second is anticlockwise of the first.
inline double cross(glm::dvec2 const& a, glm::dvec2 const& b) { return a.x * b.y - a.y * b.x; }

// From three or four corners, in pixels of a tile of up to `side` columns and rows, in either
// direction.
ConvexArea area_within(std::span<glm::dvec2 const> corners, int side);

// The same, for the part in front of a plane: where the distance from the plane, given at each
// corner, is above 0.
ConvexArea area_in_front(std::span<glm::dvec2 const> corners, std::span<double const> distances,
                         int side);

// The pixels of an area, that is, those whose centres are in it, in some rows.
struct RowSpans {
  static constexpr int most = 64;    // rows; few enough for the first-level cache
  static constexpr int at_once = 8;  // whole vectors of rows are computed

  std::array<std::int32_t, most> first;
  std::array<std::int32_t, most> length;
  std::int32_t longest;
};

// The pixels of up to RowSpans::most rows from `first_row` on, as if the area covered them all, and
// of those that follow up to a multiple of RowSpans::at_once.
void find_spans(ConvexArea const& area, int first_row, int rows, int columns, RowSpans& spans);

}  // namespace gpu_shading
