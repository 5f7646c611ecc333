#include "programs/gpu_shading/map_canvas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gpu_shading::energyplus {

MapCanvas::MapCanvas(int width, int height) : image_{width, height, 3, {}} {
  constexpr std::uint8_t white = 255;
  image_.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3,
                       white);
}

void MapCanvas::mix(int x, int y, glm::dvec3 const& colour, double share) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
  auto const at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                       static_cast<std::size_t>(x));
  for (int channel = 0; channel < 3; ++channel) {
    auto& value = image_.pixels[at + static_cast<std::size_t>(channel)];
    value = static_cast<std::uint8_t>(
        std::lround(glm::mix(static_cast<double>(value), colour[channel], share)));
  }
}

void MapCanvas::fill(glm::ivec2 const& corner, glm::ivec2 const& size, glm::dvec3 const& colour) {
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) mix(corner.x + x, corner.y + y, colour, 1.0);
  }
}

void MapCanvas::area(std::vector<glm::dvec2> const& outline, glm::dvec3 const& colour) {
  double low = image_.height;
  double high = 0.0;
  for (auto const& point : outline) {
    low = std::min(low, point.y);
    high = std::max(high, point.y);
  }
  std::vector<double> crossings;
  for (int y = std::max(static_cast<int>(low), 0); y < std::min(high, double(image_.height)); ++y) {
    double const middle = y + 0.5;
    crossings.clear();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      auto const& a = outline[i];
      auto const& b = outline[(i + 1) % outline.size()];
      if ((a.y > middle) == (b.y > middle)) continue;
      crossings.push_back(a.x + (middle - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    std::ranges::sort(crossings);
    for (std::size_t i = 1; i < crossings.size(); i += 2) {
      for (auto x = std::lround(crossings[i - 1]); x < std::lround(crossings[i]); ++x) {
        mix(static_cast<int>(x), y, colour, 1.0);
      }
    }
  }
}

void MapCanvas::line(glm::dvec2 const& a, glm::dvec2 const& b, double width,
                     glm::dvec3 const& colour) {
  double const reach = width / 2.0 + 1.0;
  auto const low = glm::ivec2(glm::floor(glm::min(a, b) - reach));
  auto const high = glm::ivec2(glm::ceil(glm::max(a, b) + reach));
  auto const along = b - a;
  double const square = std::max(glm::dot(along, along), 1e-12);
  for (int y = std::max(low.y, 0); y <= std::min(high.y, image_.height - 1); ++y) {
    for (int x = std::max(low.x, 0); x <= std::min(high.x, image_.width - 1); ++x) {
      auto const point = glm::dvec2(x, y) + 0.5;
      double const share = std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0);
      double const covered = width / 2.0 + 0.5 - glm::distance(point, a + share * along);
      if (covered > 0.0) mix(x, y, colour, std::min(covered, 1.0));
    }
  }
}

}  // namespace gpu_shading::energyplus
