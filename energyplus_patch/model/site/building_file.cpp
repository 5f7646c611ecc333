#include "model/site/building_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::json;

// The member, or nullptr.
Json const& member(Json const& object, std::string const& name) {
  static Json const none;
  if (!object.is_object()) return none;
  auto const found = object.find(name);
  return found == object.end() ? none : *found;
}

std::string type_of(Json const& object) {
  auto const& type = member(object, "type");
  return type.is_string() ? type.get<std::string>() : "";
}

std::string text_of(Json const& value) {
  return value.is_string() ? value.get<std::string>()
                           : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string name_of(Json const& feature) {
  auto const usable = [](Json const& value) {
    return value.is_number() || (value.is_string() && !value.get<std::string>().empty());
  };
  if (auto const& id = member(feature, "id"); usable(id)) return text_of(id);
  for (char const* property : {"@id", "id", "osm_id", "name"}) {
    auto const& value = member(member(feature, "properties"), property);
    if (usable(value)) return text_of(value);
  }
  return {};
}

// Limit of heights, m: more means a damaged file, or another unit.
constexpr double max_height = 10'000.0;

// The value of a property, as a number or as text: "12", "12.5 m".
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

double height_of(Json const& properties, HeightRule const& rule) {
  auto height = measure(properties, rule.height, "metres");
  auto source = rule.height;
  if (!height) {
    auto const levels = measure(properties, rule.levels, "a number of levels");
    if (levels) height = *levels * rule.storey;
    source = rule.levels;
    if (height && *height > max_height) {
      throw Error(fmt::format("{} is {} of {} m each, expected a height of at most {:.0f} m",
                              source, *levels, rule.storey, max_height));
    }
  }
  if (!height && !rule.otherwise) {
    throw Error(fmt::format("has neither {} nor {}, and Default Height is blank", rule.height,
                            rule.levels));
  }
  if (height && *height <= 0.0) {
    throw Error(fmt::format("{} is {}, expected more than 0", source,
                            printable(text_of(member(properties, source)))));
  }
  return height.value_or(rule.otherwise.value_or(0.0));
}

GeographicRing read_ring(Json const& positions, MapCoordinates const& coordinates) {
  if (!positions.is_array()) throw Error("its coordinates are not rings of positions");
  GeographicRing ring;
  ring.reserve(positions.size());
  for (auto const& position : positions) {
    if (!position.is_array() || position.size() < 2 || !position[0].is_number() ||
        !position[1].is_number()) {
      throw Error(
          fmt::format("a position is {}, expected two numbers",
                      printable(position.dump(-1, ' ', false, Json::error_handler_t::replace))));
    }
    ring.push_back(
        coordinates.to_geographic({position[0].get<double>(), position[1].get<double>()}));
  }
  return ring;
}

Footprint read_polygon(Json const& rings, MapCoordinates const& coordinates) {
  if (!rings.is_array() || rings.empty()) throw Error("its coordinates are not rings of positions");
  Footprint footprint;
  footprint.outline = read_ring(rings[0], coordinates);
  for (std::size_t i = 1; i < rings.size(); ++i) {
    footprint.holes.push_back(read_ring(rings[i], coordinates));
  }
  return footprint;
}

void add_areas(Json const& geometry, MapCoordinates const& coordinates,
               std::vector<Footprint>& areas) {
  auto const type = type_of(geometry);
  auto const& places = member(geometry, "coordinates");
  if (type == "Polygon") {
    areas.push_back(read_polygon(places, coordinates));
  } else if (type == "MultiPolygon") {
    if (!places.is_array()) throw Error("its coordinates are not polygons");
    for (auto const& polygon : places) areas.push_back(read_polygon(polygon, coordinates));
  } else if (type == "GeometryCollection") {
    for (auto const& part : member(geometry, "geometries")) add_areas(part, coordinates, areas);
  }
}

class Reader {
 public:
  Reader(BuildingFile& file, HeightRule const& heights) : file_(file), heights_(heights) {}

  void add(Json const& feature) {
    ++number_;
    Building building;
    building.name = name_of(feature);
    building.label = fmt::format("feature {}", number_);
    if (building.name.empty()) {
      building.name = std::to_string(number_);
    } else {
      building.label += fmt::format(" ({})", building.name);
    }
    naming(building.label, [&] { read(feature, building); });
    if (building.parts.empty()) {
      ++file_.others;
    } else {
      file_.buildings.push_back(std::move(building));
    }
  }

 private:
  void read(Json const& feature, Building& building) {
    bool const bare = type_of(feature) != "Feature";
    auto const& geometry = bare ? feature : member(feature, "geometry");
    add_areas(geometry, file_.coordinates, building.parts);
    if (building.parts.empty()) return;
    auto const& properties = member(feature, "properties");
    double const height = height_of(properties, heights_);
    double const base = measure(properties, "min_height", "metres").value_or(0.0);
    if (base >= height) {
      throw Error(
          fmt::format("min_height is {} m, expected less than its height of {} m", base, height));
    }
    for (auto& part : building.parts) {
      part.base = base;
      part.top = height;
    }
  }

  BuildingFile& file_;
  HeightRule const& heights_;
  std::size_t number_ = 0;
};

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

bool refuse_deep(int depth, Json::parse_event_t /*event*/, Json const& /*parsed*/) {
  constexpr int max_depth = 100;
  if (depth > max_depth) throw Error(fmt::format("is nested more than {} deep", max_depth));
  return true;
}

void read_root(Json const& root, HeightRule const& heights,
               std::optional<MapCoordinates> const& coordinates, BuildingFile& file) {
  auto const type = type_of(root);
  if (type.empty()) throw Error("is not GeoJSON: it has no type");
  file.coordinates = coordinates ? *coordinates : stated_coordinates(root);
  Reader reader(file, heights);
  if (type == "FeatureCollection") {
    for (auto const& feature : member(root, "features")) reader.add(feature);
  } else {
    reader.add(root);
  }
  if (file.buildings.empty()) throw Error("has no Polygon or MultiPolygon");
}

}  // namespace

BuildingFile read_buildings(std::filesystem::path const& path, HeightRule const& heights,
                            std::optional<MapCoordinates> const& coordinates) {
  auto const text = read_text_file(path);
  return naming(path.string(), [&] {
    BuildingFile file;
    try {
      read_root(Json::parse(text, refuse_deep), heights, coordinates, file);
    } catch (Json::exception const& error) {
      throw Error(fmt::format("is not GeoJSON: {}", reason_of(error)));
    }
    return file;
  });
}

}  // namespace gpu_shading::energyplus
