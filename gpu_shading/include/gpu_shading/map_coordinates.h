#pragma once

#include <optional>
#include <string>

#include "gpu_shading/local_axes.h"

namespace gpu_shading {

// A place on a map: x longitude, y latitude in degrees; or x easting, y northing in metres.
struct MapPoint {
  double x = 0.0;
  double y = 0.0;
};

// What a file's coordinates are: WGS84 longitude and latitude, or UTM (also UPS, its polar half),
// whose grid north is not true north and whose metres are not quite metres: both are undone point
// by point.
class MapCoordinates {
 public:
  // WGS84.
  MapCoordinates() = default;

  // "WGS84"; a zone, as in "UTM 33N", "UTM33S" or "33N"; "EPSG:4326", "EPSG:32633" and its like in
  // a URN ("urn:ogc:def:crs:EPSG::32633", "...:CRS84"); without regard to case. Throws Error.
  static MapCoordinates parse(std::string const& text);

  bool geographic() const { return !zone_; }
  // "WGS84" or "UTM 33N".
  std::string name() const;

  // Throws Error where the point is out of range: a latitude beyond a pole, or eastings and
  // northings that the zone does not have.
  GeographicPoint to_geographic(MapPoint const& point, double elevation = 0.0) const;
  // Of longitudes, which repeat, the one nearest to `near_x`.
  MapPoint from_geographic(GeographicPoint const& point, double near_x = 0.0) const;

  // Meridian convergence: from true north to grid north, degrees clockwise; 0 for WGS84.
  double convergence(MapPoint const& point) const;

 private:
  struct Zone {
    int number = 0;  // 1 .. 60; 0: UPS
    bool north = true;
  };

  std::optional<Zone> zone_;
};

}  // namespace gpu_shading
