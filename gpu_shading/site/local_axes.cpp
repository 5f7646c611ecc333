#include "gpu_shading/local_axes.h"

#include <fmt/format.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <vector>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

GeographicLib::LocalCartesian projection(GeographicPoint const& origin) {
  return {origin.latitude, origin.longitude, origin.elevation, GeographicLib::Geocentric::WGS84()};
}

}  // namespace

LocalAxes::LocalAxes(GeographicPoint const& origin) : origin_(origin) {
  // Negated so that NaN is rejected.
  if (!(std::abs(origin.latitude) <= 90.0)) {
    throw Error(fmt::format("latitude is {} degrees, expected -90 to 90", origin.latitude));
  }
  if (!std::isfinite(origin.longitude)) {
    throw Error(fmt::format("longitude is {} degrees, expected a number", origin.longitude));
  }
  if (!std::isfinite(origin.elevation)) {
    throw Error(fmt::format("elevation is {} m, expected a number", origin.elevation));
  }
}

glm::dvec3 LocalAxes::to_local(GeographicPoint const& point) const {
  glm::dvec3 local;
  projection(origin_).Forward(point.latitude, point.longitude, point.elevation, local.x, local.y,
                              local.z);
  return local;
}

GeographicPoint LocalAxes::to_geographic(glm::dvec3 const& point) const {
  GeographicPoint position;
  projection(origin_).Reverse(point.x, point.y, point.z, position.latitude, position.longitude,
                              position.elevation);
  return position;
}

glm::dmat3 LocalAxes::axes_at(GeographicPoint const& position) const {
  glm::dvec3 local;
  std::vector<double> rotation(9);  // row after row
  projection(origin_).Forward(position.latitude, position.longitude, position.elevation, local.x,
                              local.y, local.z, rotation);
  glm::dmat3 axes;
  auto element = rotation.begin();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) axes[column][row] = *element++;
  }
  return axes;
}

}  // namespace gpu_shading
