#include "geometry/convex_area.h"

#include <algorithm>

#include "platform/instructions.h"

namespace gpu_shading {
namespace {

// Position of a pixel's centre from its beginning.
constexpr float middle = 0.5F;

// Index of the first row, or pixel of a row, whose centre is beyond a position.
int first_beyond(double position, int side) {
  return static_cast<int>(std::clamp(position, 0.0, static_cast<double>(side)) + double{middle});
}

// The limits of an area as they are found.
class Limits {
 public:
  Limits(ConvexArea& area, bool anticlockwise) : area_(area), anticlockwise_(anticlockwise) {}

  // The line through an edge, which is on the area's left if the corners go anticlockwise.
  void add(glm::dvec2 const& from, glm::dvec2 const& to) {
    if (from == to) return;
    // From the lower end, for the areas on both sides.
    bool const upwards = from.y < to.y || (from.y == to.y && from.x < to.x);
    glm::dvec2 const& low = upwards ? from : to;
    glm::dvec2 const& high = upwards ? to : from;
    constexpr double level = 1e-12;
    double const slope = (high.x - low.x) / std::max(high.y - low.y, level);
    RowLimit const limit{static_cast<float>(low.x + (0.5 - low.y) * slope),
                         static_cast<float>(slope)};
    if (upwards == anticlockwise_) {
      area_.right[rights_++] = limit;
    } else {
      area_.left[lefts_++] = limit;
    }
  }

  void fill_up(int side) {
    area_.limits = std::max(lefts_, rights_);
    std::fill(area_.left.begin() + lefts_, area_.left.end(), RowLimit{0.0F, 0.0F});
    std::fill(area_.right.begin() + rights_, area_.right.end(),
              RowLimit{static_cast<float>(side), 0.0F});
  }

 private:
  ConvexArea& area_;
  bool anticlockwise_;
  std::size_t lefts_ = 0;
  std::size_t rights_ = 0;
};

// For a block of rows, written so that the compiler can vectorise it.
template <std::size_t limits>
[[gnu::always_inline]] inline void find_some(ConvexArea const& area, int first_row, int rows,
                                             int columns, RowSpans& spans) {
  auto const width = static_cast<float>(columns);
  std::int32_t longest = 0;
  int const whole = (rows + RowSpans::at_once - 1) / RowSpans::at_once * RowSpans::at_once;
  for (int i = 0; i < whole; ++i) {
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

[[gnu::always_inline]] inline void find_all(ConvexArea const& area, int first_row, int rows,
                                            int columns, RowSpans& spans) {
  switch (area.limits) {
    case 1:
      return find_some<1>(area, first_row, rows, columns, spans);
    case 2:
      return find_some<2>(area, first_row, rows, columns, spans);
    case 3:
      return find_some<3>(area, first_row, rows, columns, spans);
    default:
      return find_some<ConvexArea::max_limits>(area, first_row, rows, columns, spans);
  }
}

}  // namespace

ConvexArea area_within(std::span<glm::dvec2 const> corners, int side) {
  return area_in_front(corners, {}, side);
}

ConvexArea area_in_front(std::span<glm::dvec2 const> corners, std::span<double const> distances,
                         int side) {
  std::size_t const count = corners.size();
  double twice_area = 0.0;
  double low = corners[0].y;
  double high = low;
  for (std::size_t i = 1; i < count; ++i) {
    twice_area += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    low = std::min(low, corners[i].y);
    high = std::max(high, corners[i].y);
  }
  std::size_t const in_front =
      distances.empty()
          ? count
          : static_cast<std::size_t>(std::count_if(distances.begin(), distances.end(),
                                                   [](double distance) { return distance > 0.0; }));
  // The one object that is returned, so that it is not copied.
  ConvexArea area;
  int const first_row = first_beyond(low, side);
  int const end_row = first_beyond(high, side);
  if (twice_area == 0.0 || in_front == 0 || first_row >= end_row) return area;
  Limits limits(area, twice_area > 0.0);
  for (std::size_t i = 0; i + 1 < count; ++i) limits.add(corners[i], corners[i + 1]);
  limits.add(corners[count - 1], corners[0]);
  if (in_front < count) {
    glm::dvec2 leaves(0.0);
    glm::dvec2 enters(0.0);
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t const next = i + 1 < count ? i + 1 : 0;
      if ((distances[i] > 0.0) == (distances[next] > 0.0)) continue;
      double const share = distances[i] / (distances[i] - distances[next]);
      (distances[i] > 0.0 ? leaves : enters) = corners[i] + share * (corners[next] - corners[i]);
    }
    if (leaves == enters) return area;
    limits.add(leaves, enters);
  }
  limits.fill_up(side);
  area.first_row = first_row;
  area.end_row = end_row;
  return area;
}

void find_spans(ConvexArea const& area, int first_row, int rows, int columns, RowSpans& spans) {
  run<find_all>(area, first_row, rows, columns, spans);
}

}  // namespace gpu_shading
