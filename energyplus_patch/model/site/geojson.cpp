#include "model/site/geojson.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus::geojson {
namespace {

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

void read_root(Json const& root, MapCoordinates const& coordinates,
               std::function<void(Feature const&, MapCoordinates const&)> const& use) {
  std::size_t number = 0;
  auto const add = [&](Json const& feature) {
    ++number;
    bool const bare = type_of(feature) != "Feature";
    Feature each{name_of(feature), fmt::format("feature {}", number),
                 bare ? feature : member(feature, "geometry"), member(feature, "properties")};
    if (each.name.empty()) {
      each.name = std::to_string(number);
    } else {
      each.label += fmt::format(" ({})", each.name);
    }
    naming(each.label, [&] { use(each, coordinates); });
  };
  if (type_of(root) == "FeatureCollection") {
    for (auto const& feature : member(root, "features")) add(feature);
  } else {
    add(root);
  }
}

}  // namespace

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

GeographicPoint read_position(Json const& position, MapCoordinates const& coordinates) {
  if (!position.is_array() || position.size() < 2 || !position[0].is_number() ||
      !position[1].is_number()) {
    throw Error(
        fmt::format("a position is {}, expected two numbers",
                    printable(position.dump(-1, ' ', false, Json::error_handler_t::replace))));
  }
  return coordinates.to_geographic({position[0].get<double>(), position[1].get<double>()});
}

MapCoordinates read_features(
    std::filesystem::path const& path, std::optional<MapCoordinates> const& coordinates,
    std::function<void(Feature const&, MapCoordinates const&)> const& use) {
  auto const text = read_text_file(path);
  return naming(path.string(), [&] {
    try {
      auto const root = Json::parse(text, refuse_deep);
      if (type_of(root).empty()) throw Error("is not GeoJSON: it has no type");
      auto const used = coordinates ? *coordinates : stated_coordinates(root);
      read_root(root, used, use);
      return used;
    } catch (Json::exception const& error) {
      throw Error(fmt::format("is not GeoJSON: {}", reason_of(error)));
    }
  });
}

}  // namespace gpu_shading::energyplus::geojson
