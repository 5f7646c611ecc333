#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace gpu_shading {

// As the sun sees it with its head up: right and up across the rays. A sun in the zenith has north
// up.
struct SunAxes {
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up;

  explicit SunAxes(glm::dvec3 const& towards_sun) {
    glm::dvec3 const sideways = glm::cross(glm::dvec3(0.0, 0.0, 1.0), towards_sun);
    constexpr double zenith = 1e-9;
    if (glm::length(sideways) > zenith) right = glm::normalize(sideways);
    up = glm::cross(towards_sun, right);
  }
  glm::dvec2 operator()(glm::dvec3 const& point) const {
    return {glm::dot(right, point), glm::dot(up, point)};
  }
};

// What a picture shows, in metres along its axes.
struct PictureFrame {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};

  void include(glm::dvec2 const& place) {
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  double longer() const { return std::max(high.x - low.x, high.y - low.y); }
  PictureFrame widened(double by) const { return {low - by, high + by}; }
};

// From a point along an axis to clip coordinates.
inline glm::dvec4 clip_row(glm::dvec3 const& axis, double low, double high) {
  double const scale = 2.0 / (high - low);
  return {axis * scale, -scale * 0.5 * (low + high)};
}

}  // namespace gpu_shading
