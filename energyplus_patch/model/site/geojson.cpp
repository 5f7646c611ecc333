#include "model/site/geojson.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <numbers>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/site/flat_geobuf.h"
#include "model/site/geo_package.h"
#include "model/site/sqlite_file.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus::geojson {
namespace {

std::string name_in(Json const& object, std::initializer_list<char const*> members) {
  for (char const* name : members) {
    auto const& value = member(object, name);
    if (value.is_number() || (value.is_string() && !value.get<std::string>().empty()))
      return text_of(value);
  }
  return {};
}

GeographicPoint read_position(Json const& position, MapCoordinates const& coordinates) {
  if (!position.is_array() || position.size() < 2 || !position[0].is_number() ||
      !position[1].is_number()) {
    throw Error(
        fmt::format("a position is {}, expected two numbers",
                    printable(position.dump(-1, ' ', false, Json::error_handler_t::replace))));
  }
  return coordinates.to_geographic({position[0].get<double>(), position[1].get<double>()});
}

std::vector<GeographicPoint> read_positions(Json const& positions,
                                            MapCoordinates const& coordinates,
                                            char const* expected) {
  if (!positions.is_array()) throw Error(fmt::format("its coordinates are not {}", expected));
  std::vector<GeographicPoint> points;
  points.reserve(positions.size());
  for (auto const& position : positions) points.push_back(read_position(position, coordinates));
  return points;
}

Footprint read_area(Json const& rings, MapCoordinates const& coordinates) {
  constexpr char const* expected = "rings of positions";
  if (!rings.is_array() || rings.empty())
    throw Error(fmt::format("its coordinates are not {}", expected));
  Footprint area;
  area.outline = read_positions(rings[0], coordinates, expected);
  for (std::size_t i = 1; i < rings.size(); ++i) {
    area.holes.push_back(read_positions(rings[i], coordinates, expected));
  }
  return area;
}

void add_areas(Json const& geometry, MapCoordinates const& coordinates,
               std::vector<Footprint>& areas) {
  auto const type = type_of(geometry);
  auto const& places = member(geometry, "coordinates");
  if (type == "Polygon") {
    areas.push_back(read_area(places, coordinates));
  } else if (type == "MultiPolygon") {
    if (!places.is_array()) throw Error("its coordinates are not polygons");
    for (auto const& polygon : places) areas.push_back(read_area(polygon, coordinates));
  } else if (type == "GeometryCollection") {
    for (auto const& part : member(geometry, "geometries")) add_areas(part, coordinates, areas);
  }
}

Geometry read_geometry(Json const& json, MapCoordinates const& coordinates) {
  Geometry geometry;
  auto const type = type_of(json);
  auto const& places = member(json, "coordinates");
  if (type == "Point") {
    geometry.points = {read_position(places, coordinates)};
  } else if (type == "MultiPoint") {
    geometry.points = read_positions(places, coordinates, "positions");
  } else {
    add_areas(json, coordinates, geometry.areas);
  }
  return geometry;
}

// The older standard's member: {"crs": {"type": "name", "properties": {"name": "..."}}}.
MapCoordinates stated_coordinates(Json const& root) {
  auto const& crs = member(root, "crs");
  if (crs.is_null()) return {};
  auto const& name = member(member(crs, "properties"), "name");
  try {
    return MapCoordinates::parse(text_of(name.is_null() ? crs : name));
  } catch (Error const& error) {
    throw Error(fmt::format("crs is {}", error.what()));
  }
}

// Parses a file and returns its root without features, which are passed to `use` one by one.
Json parse_features(std::filesystem::path const& path,
                    std::function<void(Json const&)> const& use) {
  constexpr int max_depth = 100;
  constexpr std::size_t max_values = 20'000'000;  // of a feature, or of the rest
  std::string name;                               // of the root's member
  bool in_features = false;
  std::size_t values = 0;
  auto const watch = [&](int depth, Json::parse_event_t event, Json const& parsed) {
    using Event = Json::parse_event_t;
    if (depth > max_depth) throw Error(fmt::format("is nested more than {} deep", max_depth));
    if (++values > max_values) {
      throw Error(fmt::format("has more than {} values in one feature", max_values));
    }
    if (depth == 1 && event == Event::key) name = parsed.get<std::string>();
    if (depth == 1 && event == Event::array_start) in_features = name == "features";
    if (depth == 1 && event == Event::array_end) in_features = false;
    bool const complete =
        event == Event::object_end || event == Event::array_end || event == Event::value;
    if (!in_features || depth != 2 || !complete) return true;
    use(parsed);
    values = 0;
    return false;
  };
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("cannot be read");
  try {
    auto root = Json::parse(file, watch);
    if (type_of(root).empty()) throw Error("is not GeoJSON: it has no type");
    return root;
  } catch (Json::exception const& error) {
    throw Error(fmt::format("is not GeoJSON: {}", reason_of(error)));
  }
}

MapCoordinates read_geojson(std::filesystem::path const& path,
                            std::optional<MapCoordinates> const& coordinates,
                            UseFeature const& use) {
  // The type and the crs may come after the features.
  auto const root = parse_features(path, [](Json const& /*feature*/) {});
  auto const used = coordinates ? *coordinates : stated_coordinates(root);
  std::size_t number = 0;
  auto const add = [&](Json const& feature) {
    bool const bare = type_of(feature) != "Feature";
    auto const read = [&] {
      return read_geometry(bare ? feature : member(feature, "geometry"), used);
    };
    use_numbered(name_in(feature, {"id"}), member(feature, "properties"), ++number, read, use);
  };
  if (type_of(root) == "FeatureCollection") {
    parse_features(path, add);
  } else {
    add(root);
  }
  return used;
}

}  // namespace

Json const& member(Json const& object, std::string_view name) {
  static Json const none;
  if (!object.is_object()) return none;
  auto const found = object.find(name);
  return found == object.end() ? none : *found;
}

std::string type_of(Json const& object) {
  auto const& type = member(object, "type");
  return type.is_string() ? type.get<std::string>() : "";
}

std::optional<double> measure(Json const& properties, std::string const& name,
                              std::string_view expected) {
  auto const& value = member(properties, name);
  if (value.is_null()) return std::nullopt;
  auto text = text_of(value);
  if (text.empty()) return std::nullopt;
  auto number = text;
  if (value.is_string() && number.ends_with('m')) number.pop_back();
  while (number.ends_with(' ')) number.pop_back();
  auto const parsed = parse_number(number);
  if (!parsed || !(std::abs(*parsed) <= max_height)) {
    throw Error(fmt::format("{} is {}, expected {} of at most {:.0f}", name, in_quotes(text),
                            expected, max_height));
  }
  return parsed;
}

void GeographicExtent::include(GeographicPoint const& point) {
  south = std::min(south, point.latitude);
  north = std::max(north, point.latitude);
  west = std::min(west, point.longitude);
  east = std::max(east, point.longitude);
}

bool Box::meets_any(std::vector<Box> const& others) const {
  return std::any_of(others.begin(), others.end(), [&](Box const& other) {
    return west <= other.east && other.west <= east && south <= other.north && other.south <= north;
  });
}

bool Nearby::reaches(GeographicExtent const& extent) const {
  constexpr double turn = 360.0;
  if (extent.south > extent.north) return false;
  double const middle = (extent.west + extent.east) / 2.0;
  auto const& centre = axes_.origin();
  double const longitude = centre.longitude + turn * std::round((middle - centre.longitude) / turn);
  auto const nearest = axes_.to_local({std::clamp(centre.latitude, extent.south, extent.north),
                                       std::clamp(longitude, extent.west, extent.east), 0.0});
  return std::hypot(nearest.x, nearest.y) <= radius_ && nearest.z > -radius_;
}

bool Nearby::reaches(Geometry const& geometry) const {
  GeographicExtent extent;
  for (auto const& point : geometry.points) extent.include(point);
  for (auto const& area : geometry.areas) {
    for (auto const& corner : area.outline) extent.include(corner);
  }
  return reaches(extent);
}

std::vector<Box> Nearby::boxes(MapCoordinates const& coordinates) const {
  auto const place = coordinates.from_geographic(axes_.origin());
  if (!coordinates.geographic()) {
    // UTM's scale is 0.9996 and more, and by far less than this within a zone and beside it.
    constexpr double margin = 1.01;
    double const reach = radius_ * margin;
    return {{place.x - reach, place.y - reach, place.x + reach, place.y + reach}};
  }
  constexpr double metres_of_degree = 110'000.0;  // less than anywhere on the ellipsoid
  constexpr double turn = 360.0;
  constexpr double pole = 89.0;
  double const high = radius_ / metres_of_degree;
  double const farthest = std::abs(place.y) + high;
  double const wide =
      farthest > pole ? turn : high / std::cos(farthest * std::numbers::pi / (turn / 2.0));
  std::vector<Box> boxes;
  for (double const shift : {-turn, 0.0, turn}) {
    boxes.push_back(
        {place.x - wide + shift, place.y - high, place.x + wide + shift, place.y + high});
  }
  return boxes;
}

void use_numbered(std::string id, Json const& properties, std::size_t number,
                  std::function<Geometry()> const& read_geometry, UseFeature const& use) {
  if (id.empty()) id = name_in(properties, {"@id", "id", "osm_id", "name"});
  Feature feature{std::move(id), fmt::format("feature {}", number), {}, properties};
  if (feature.name.empty()) {
    feature.name = std::to_string(number);
  } else {
    feature.label += fmt::format(" ({})", feature.name);
  }
  naming(feature.label, [&] {
    feature.geometry = read_geometry();
    use(feature);
  });
}

MapCoordinates read_features(std::filesystem::path const& path,
                             std::optional<MapCoordinates> const& coordinates,
                             std::optional<Nearby> const& nearby, UseFeature const& use) {
  constexpr std::string_view mark = "|layername=";
  auto const name = path.string();
  auto const end = name.find(mark);
  std::filesystem::path const file(name.substr(0, end));
  auto const layer = end == std::string::npos ? "" : name.substr(end + mark.size());
  require_file(file);
  auto const use_near = [&](Feature& feature) {
    if (!nearby || nearby->reaches(feature.geometry)) use(feature);
  };
  return naming(file.string(), [&] {
    if (is_sqlite(file)) return read_geo_package(file, layer, coordinates, nearby, use_near);
    if (!layer.empty())
      throw Error(fmt::format("is no GeoPackage, but layer {} is asked for", layer));
    if (is_flat_geobuf(file)) return read_flat_geobuf(file, coordinates, nearby, use_near);
    return read_geojson(file, coordinates, use_near);
  });
}

}  // namespace gpu_shading::energyplus::geojson
