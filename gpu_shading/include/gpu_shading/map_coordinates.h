#pragma once

#include <optional>
#include <string>

#include "gpu_shading/local_axes.h"

namespace gpu_shading {

// A point on a map: x longitude and y latitude in degrees, or x easting and y northing in metres.
struct MapPoint {
  double x = 0.0;
  double y = 0.0;
};

// The coordinate system of a file: WGS84 longitude and latitude, or UTM (and UPS, its polar
// counterpart). UTM's grid north is not true north and its metres are scaled; both are corrected
// point by point.
class MapCoordinates {
 public:
  // WGS84.
  MapCoordinates() = default;

  // Parses "WGS84"; a zone, as in "UTM 33N", "UTM33S" or "33N"; or "EPSG:4326", "EPSG:32633" and
  // similar, also as a URN ("urn:ogc:def:crs:EPSG::32633", "...:CRS84"). Case is ignored. Throws
  // Error.
  static MapCoordinates parse(std::string const& text);

  bool geographic() const { return !zone_; }
  // "WGS84" or "UTM 33N".
  std::string name() const;

  // Throws Error if the point is out of range: a latitude beyond a pole, or eastings and northings
  // outside the zone.
  GeographicPoint to_geographic(MapPoint const& point, double elevation = 0.0) const;
  // For longitudes, which repeat, returns the value nearest to `near_x`.
  MapPoint from_geographic(GeographicPoint const& point, double near_x = 0.0) const;

  // Meridian convergence: the angle from true north to grid north, in degrees clockwise; 0 for
  // WGS84.
  double convergence(MapPoint const& point) const;

 private:
  struct Zone {
    int number = 0;  // 1 .. 60; 0: UPS
    bool north = true;
  };

  std::optional<Zone> zone_;
};

}  // namespace gpu_shading
