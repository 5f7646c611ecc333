#include "pictures/picture_frame.h"

#include <cmath>
#include <glm/vec4.hpp>

namespace gpu_shading {
namespace {

// From a point along an axis to -1 .. 1.
glm::dvec4 row_along(glm::dvec3 const& axis, double low, double high) {
  double const scale = 2.0 / (high - low);
  return {axis * scale, -scale * 0.5 * (low + high)};
}

}  // namespace

PictureGrid make_grid(PictureFrame const& frame, SunAxes const& axes, glm::dvec3 const& origin,
                      double reach, int size) {
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
