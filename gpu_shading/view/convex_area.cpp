#include "view/convex_area.h"

#include <algorithm>

#include "view/instructions.h"

namespace gpu_shading {
namespace {

// Position of a pixel's centre from its beginning.
constexpr float middle = 0.5F;

// Index of the first row, or pixel of a row, whose centre is beyond a position.
int first_beyond(double place, int side) {
  return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(side)) + double{middle});
}

// The line through an edge of an area, which is on its left if the corners go anticlockwise.
void add_limit(ConvexArea& area, std::ptrdiff_t& lefts, std::ptrdiff_t& rights,
               glm::dvec2 const& from, glm::dvec2 const& to, bool anticlockwise) {
  if (from == to) return;
  // From the lower end, for the areas on both sides.
  bool const upwards = from.y < to.y || (from.y == to.y && from.x < to.x);
  glm::dvec2 const& low = upwards ? from : to;
  glm::dvec2 const& high = upwards ? to : from;
  constexpr double level = 1e-12;
  double const slope = (high.x - low.x) / std::max(high.y - low.y, level);
  RowLimit const limit{static_cast<float>(low.x + (0.5 - low.y) * slope),
                       static_cast<float>(slope)};
  if (upwards == anticlockwise) {
    area.right.at(static_cast<std::size_t>(rights++)) = limit;
  } else {
    area.left.at(static_cast<std::size_t>(lefts++)) = limit;
  }
}

// For a block of rows, written so that the compiler can vectorise it.
template <std::size_t limits>
[[gnu::always_inline]] inline void find_some(ConvexArea const& area, int first_row, int side,
                                             RowSpans& spans) {
  auto const width = static_cast<float>(side);
  std::int32_t longest = 0;
  for (int i = 0; i < RowSpans::rows; ++i) {
    auto const row = static_cast<float>(first_row + i);
    float from = 0.0F;
    float to = width;
    for (std::size_t k = 0; k < limits; ++k) {
      float const left = area.left[k].start + row * area.left[k].slope;
      float const right = area.right[k].start + row * area.right[k].slope;
      from = left > from ? left : from;
      to = right < to ? right : to;
    }
    from = from < width ? from : width;
    to = to > 0.0F ? to : 0.0F;
    auto const first = static_cast<std::int32_t>(from + middle);
    auto const end = static_cast<std::int32_t>(to + middle);
    std::int32_t const length = end > first ? end - first : 0;
    spans.first[static_cast<std::size_t>(i)] = first;
    spans.length[static_cast<std::size_t>(i)] = length;
    longest = length > longest ? length : longest;
  }
  spans.longest = longest;
}

[[gnu::always_inline]] inline void find_all(ConvexArea const& area, int first_row, int side,
                                            RowSpans& spans) {
  switch (area.limits) {
    case 1:
      return find_some<1>(area, first_row, side, spans);
    case 2:
      return find_some<2>(area, first_row, side, spans);
    case 3:
      return find_some<3>(area, first_row, side, spans);
    default:
      return find_some<ConvexArea::most_limits>(area, first_row, side, spans);
  }
}

}  // namespace

ConvexArea area_within(std::span<glm::dvec2 const> corners, int side) {
  return area_in_front(corners, {}, side);
}

ConvexArea area_in_front(std::span<glm::dvec2 const> corners, std::span<double const> distances,
                         int side) {
  ConvexArea area;
  double twice_area = 0.0;
  double low = corners[0].y;
  double high = low;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i > 0) twice_area += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    low = std::min(low, corners[i].y);
    high = std::max(high, corners[i].y);
  }
  bool const anticlockwise = twice_area > 0.0;
  std::ptrdiff_t lefts = 0;
  std::ptrdiff_t rights = 0;
  glm::dvec2 leaves(0.0);
  glm::dvec2 enters(0.0);
  bool cut = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::size_t const next = (i + 1) % corners.size();
    add_limit(area, lefts, rights, corners[i], corners[next], anticlockwise);
    if (distances.empty() || (distances[i] > 0.0) == (distances[next] > 0.0)) continue;
    cut = true;
    double const share = distances[i] / (distances[i] - distances[next]);
    (distances[i] > 0.0 ? leaves : enters) = corners[i] + share * (corners[next] - corners[i]);
  }
  bool const behind = !distances.empty() && !cut && !(distances[0] > 0.0);
  if (twice_area == 0.0 || behind || (cut && leaves == enters)) return {};
  if (cut) add_limit(area, lefts, rights, leaves, enters, anticlockwise);
  area.limits = static_cast<std::size_t>(std::max(lefts, rights));
  std::fill(area.left.begin() + lefts, area.left.end(), RowLimit{0.0F, 0.0F});
  std::fill(area.right.begin() + rights, area.right.end(),
            RowLimit{static_cast<float>(side), 0.0F});
  area.first_row = first_beyond(low, side);
  area.end_row = first_beyond(high, side);
  return area;
}

void find_spans(ConvexArea const& area, int first_row, int side, RowSpans& spans) {
  run<find_all>(area, first_row, side, spans);
}

}  // namespace gpu_shading
