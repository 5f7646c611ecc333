#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace gpu_shading {

// A geographic position (WGS84): latitude -90 .. 90 and longitude in degrees, east positive, any
// number of turns; elevation in metres above the ellipsoid. Elevations above sea level may be used
// throughout. The two differ by the geoid's height (-107 .. 86 m), which changes by a few metres at
// most within one site and so moves a point 30 km away by half a metre.
struct GeographicPoint {
  double latitude = 0.0;
  double longitude = 0.0;
  double elevation = 0.0;
};

// World axes of a model at an origin on the earth: x east, y north, z up, in metres. The axes are
// Cartesian, so the earth curves away below them (70.6 m at 30 km), a distant building tilts
// outwards, and the sun direction is the same everywhere. At a pole, the longitude of the origin
// defines east.
class LocalAxes {
 public:
  // Throws Error for an invalid position: "latitude is 91 degrees, expected -90 to 90".
  explicit LocalAxes(GeographicPoint const& origin);

  GeographicPoint const& origin() const { return origin_; }

  glm::dvec3 to_local(GeographicPoint const& point) const;
  GeographicPoint to_geographic(glm::dvec3 const& point) const;

  // A matrix whose columns are the unit vectors east, north and up at a position.
  glm::dmat3 axes_at(GeographicPoint const& position) const;

 private:
  GeographicPoint origin_;
  // Of the origin, in axes that are fixed to the earth: its position and the columns of axes_at.
  glm::dvec3 centre_{0.0};
  glm::dmat3 axes_{1.0};
};

}  // namespace gpu_shading
