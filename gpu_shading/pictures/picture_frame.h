#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
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
  void include(glm::dvec2 const& place) {
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  double longer() const { return std::max(high.x - low.x, high.y - low.y); }
  PictureFrame widened(double by) const { return {low - by, high + by}; }
};

// A frame about `origin` in pixels, `size` on its longer side. `reach`: no surface is farther from
// the origin, m.
PictureGrid make_grid(PictureFrame const& frame, SunAxes const& axes, glm::dvec3 const& origin,
                      double reach, int size);

}  // namespace gpu_shading
