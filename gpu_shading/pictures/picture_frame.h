#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "backends/interface/picture_raster.h"

namespace gpu_shading {

// The axes of a picture as the sun sees it: right and up, perpendicular to the rays. With the sun
// in the zenith, north is up.
struct SunAxes {
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up;
  glm::dvec3 towards_sun;

  explicit SunAxes(glm::dvec3 const& sun) : towards_sun(sun) {
    glm::dvec3 const sideways = glm::cross(glm::dvec3(0.0, 0.0, 1.0), sun);
    constexpr double zenith = 1e-9;
    if (glm::length(sideways) > zenith) right = glm::normalize(sideways);
    up = glm::cross(sun, right);
  }
  glm::dvec2 operator()(glm::dvec3 const& point) const {
    return {glm::dot(right, point), glm::dot(up, point)};
  }
};

// The extent of a picture, in metres along its axes.
struct PictureFrame {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(low.x <= high.x); }
  void include(glm::dvec2 const& position) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  void include(PictureFrame const& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  double longer() const { return std::max(high.x - low.x, high.y - low.y); }
  PictureFrame widened(double by) const { return {low - by, high + by}; }
};

// From a point along an axis to -1 .. 1.
inline glm::dvec4 row_along(glm::dvec3 const& axis, double low, double high) {
  double const scale = 2.0 / (high - low);
  return {axis * scale, -scale * 0.5 * (low + high)};
}

// A frame about `origin` in pixels, `size` on its longer side. `reach`: no surface is farther from
// the origin, m.
inline PictureGrid make_grid(PictureFrame const& frame, SunAxes const& axes,
                             glm::dvec3 const& origin, double reach, int size) {
  auto const pixels = [&](double length) {
    return std::clamp(static_cast<int>(std::lround(size * length / frame.longer())), 1, size);
  };
  PictureGrid grid;
  grid.view.origin = origin;
  grid.view.x = row_along(axes.right, frame.low.x, frame.high.x);
  grid.view.y = row_along(axes.up, frame.low.y, frame.high.y);
  grid.view.z = glm::dvec4(-0.5 * axes.towards_sun / reach, 0.5);
  grid.width = pixels(frame.high.x - frame.low.x);
  grid.height = pixels(frame.high.y - frame.low.y);
  return grid;
}

}  // namespace gpu_shading
