#include "gpu_shading/local_axes.h"

#include <fmt/format.h>

#include <GeographicLib/Geocentric.hpp>
#include <cmath>
#include <glm/matrix.hpp>
#include <vector>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

// In axes that are fixed to the earth.
struct Place {
  glm::dvec3 point{0.0};
  glm::dmat3 axes{1.0};  // columns: east, north, up
};

Place place_of(GeographicPoint const& position) {
  Place place;
  std::vector<double> rotation(9);  // row after row
  GeographicLib::Geocentric::WGS84().Forward(position.latitude, position.longitude,
                                             position.elevation, place.point.x, place.point.y,
                                             place.point.z, rotation);
  auto element = rotation.begin();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) place.axes[column][row] = *element++;
  }
  return place;
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
  auto const place = place_of(origin);
  centre_ = place.point;
  axes_ = place.axes;
}

glm::dvec3 LocalAxes::to_local(GeographicPoint const& point) const {
  glm::dvec3 there;
  GeographicLib::Geocentric::WGS84().Forward(point.latitude, point.longitude, point.elevation,
                                             there.x, there.y, there.z);
  return glm::transpose(axes_) * (there - centre_);
}

GeographicPoint LocalAxes::to_geographic(glm::dvec3 const& point) const {
  auto const there = centre_ + axes_ * point;
  GeographicPoint position;
  GeographicLib::Geocentric::WGS84().Reverse(there.x, there.y, there.z, position.latitude,
                                             position.longitude, position.elevation);
  return position;
}

glm::dmat3 LocalAxes::axes_at(GeographicPoint const& position) const {
  return glm::transpose(axes_) * place_of(position).axes;
}

}  // namespace gpu_shading
