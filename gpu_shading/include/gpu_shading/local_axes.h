#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace gpu_shading {

// A place on earth: WGS84. Latitude -90 .. 90 and longitude in degrees, east positive, any number
// of turns; elevation in metres above the ellipsoid. Elevations above sea level may be used
// throughout: the two differ by the geoid's height (-107 .. 86 m), which within one site changes by
// metres at most and moves a place 30 km away by half a metre.
struct GeographicPoint {
  double latitude = 0.0;
  double longitude = 0.0;
  double elevation = 0.0;
};

// World axes of a model that stands at a place: x east, y true north, z up, metres, (0, 0, 0) at
// the place. Cartesian, so that the earth curves away below them (70.6 m at 30 km) and a far
// house leans outwards as it does; the sun's direction is the same everywhere. At a pole the
// place's longitude tells where east is.
class LocalAxes {
 public:
  // Throws Error where the place is none: "latitude is 91 degrees, expected -90 to 90".
  explicit LocalAxes(GeographicPoint const& origin);

  GeographicPoint const& origin() const { return origin_; }

  glm::dvec3 to_local(GeographicPoint const& point) const;
  GeographicPoint to_geographic(glm::dvec3 const& point) const;

  // Unit vectors east, north and up at a place, its columns.
  glm::dmat3 axes_at(GeographicPoint const& place) const;

 private:
  GeographicPoint origin_;
};

}  // namespace gpu_shading
