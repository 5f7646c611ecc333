#include "model/site/horizon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace gpu_shading::energyplus {
namespace {

// East, north and up at an azimuth in degrees, clockwise from north.
glm::dvec3 at_azimuth(double azimuth) {
  return {std::sin(glm::radians(azimuth)), std::cos(glm::radians(azimuth)), 0.0};
}

double azimuth_of(glm::dvec3 const& point) { return glm::degrees(std::atan2(point.x, point.y)); }

double cross(glm::dvec3 const& a, glm::dvec3 const& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

void Horizon::include(Ring const& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    include(outline[i], outline[(i + 1) % outline.size()]);
  }
}

void Horizon::include(glm::dvec3 const& from, glm::dvec3 const& to) {
  double const first = azimuth_of(from);
  double const turn = std::remainder(azimuth_of(to) - first, 1.0 * degrees);
  double const low = std::min(first, first + turn) - 0.5;
  auto const last = static_cast<int>(std::floor(low + std::abs(turn)));
  for (auto degree = static_cast<int>(std::ceil(low)); degree <= last; ++degree) {
    auto const direction = at_azimuth(degree + 0.5);
    auto const edge = to - from;
    double const along = -cross(from, direction) / cross(edge, direction);
    auto const point = from + std::clamp(along, 0.0, 1.0) * edge;
    double const distance = glm::dot(point, direction);
    auto& highest = highest_.at(static_cast<std::size_t>(degree + degrees) % degrees);
    // Negated so that NaN is left out.
    if (!(distance > 0.0 && point.z > highest.slope * distance)) continue;
    highest = {point.z / distance, distance};
  }
}

std::vector<Polygon> Horizon::faces() const {
  double const longer = 1.0 / std::cos(glm::radians(0.5));
  std::vector<Polygon> faces;
  for (std::size_t degree = 0; degree < highest_.size(); ++degree) {
    auto const& [slope, distance] = highest_[degree];
    if (slope <= 0.0) continue;
    auto const left = longer * distance * at_azimuth(static_cast<double>(degree));
    auto const right = longer * distance * at_azimuth(static_cast<double>(degree) + 1.0);
    glm::dvec3 const up{0.0, 0.0, slope * distance};
    faces.push_back({{left + up, left, right, right + up}, {}});
  }
  return faces;
}

}  // namespace gpu_shading::energyplus
