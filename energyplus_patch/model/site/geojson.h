#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu_shading/footprint.h"
#include "gpu_shading/local_axes.h"
#include "gpu_shading/map_coordinates.h"

// Files of features, as GeoJSON (RFC 7946) has them. Functions throw Error without the file's name.
namespace gpu_shading::energyplus::geojson {

using Json = nlohmann::json;

// The member, or null.
Json const& member(Json const& object, std::string_view name);
std::string type_of(Json const& object);

// Limit of heights, m: more means a damaged file, or another unit.
inline constexpr double max_height = 10'000.0;

// The value of a property, as a number or as text: "12", "12.5 m".
std::optional<double> measure(Json const& properties, std::string const& name,
                              std::string_view expected);

// What is not in it is of other kinds, as lines are.
struct Geometry {
  std::vector<GeographicPoint> points;  // of a Point or MultiPoint
  // Of Polygons, also in collections, without heights.
  std::vector<Footprint> areas;
};

// A member of a FeatureCollection, or a single feature or geometry.
struct Feature {
  // Its id, or its property @id, id, osm_id or name, or its number, from 1.
  std::string name;
  std::string label;  // for messages: "feature 3 (way/17)"
  Geometry geometry;
  Json const& properties;
};

// The extent of positions, in degrees.
struct GeographicExtent {
  double south = std::numeric_limits<double>::infinity();
  double north = -std::numeric_limits<double>::infinity();
  double west = std::numeric_limits<double>::infinity();
  double east = -std::numeric_limits<double>::infinity();

  void include(GeographicPoint const& point);
};

// A rectangle of a file's coordinates.
struct Box {
  double west;
  double south;
  double east;
  double north;

  bool meets_any(std::vector<Box> const& others) const;
};

// A circle on the ground. A feature is in it if the bounding box of its positions is, in part.
class Nearby {
 public:
  // In metres.
  Nearby(GeographicPoint const& centre, double radius)
      : axes_({centre.latitude, centre.longitude, 0.0}), radius_(radius) {}

  double radius() const { return radius_; }
  bool reaches(GeographicExtent const& extent) const;
  bool reaches(Geometry const& geometry) const;
  // Together they have the circle in them, which may cross the antimeridian.
  std::vector<Box> boxes(MapCoordinates const& coordinates) const;

 private:
  LocalAxes axes_;
  double radius_;
};

using UseFeature = std::function<void(Feature&)>;

// Names and labels a feature by its number, and reads its geometry as that of this feature. `id`:
// "" if it has none.
void use_numbered(std::string id, Json const& properties, std::size_t number,
                  std::function<Geometry()> const& read_geometry, UseFeature const& use);

// Calls use(feature) for each feature of a file of GeoJSON, FlatGeobuf or GeoPackage,
// which its first bytes tell, or for those in the circle. Only one is in memory at a time.
// The name of a GeoPackage may end in "|layername=LAYER", as in GDAL and QGIS, which is needed
// where it has several. `coordinates`: if empty, those that the file names (in GeoJSON the older
// "crs" member), or WGS84. Returns them. Throws Error: "FILE: feature 3 (way/17): ...".
MapCoordinates read_features(std::filesystem::path const& path,
                             std::optional<MapCoordinates> const& coordinates,
                             std::optional<Nearby> const& nearby, UseFeature const& use);

}  // namespace gpu_shading::energyplus::geojson
