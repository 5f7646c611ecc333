#include "model/site/building_file.h"

#include <fmt/format.h>

#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

using geojson::Json;
using geojson::measure;
using geojson::member;
using geojson::type_of;

double height_of(Json const& properties, HeightRule const& rule) {
  auto height = measure(properties, rule.height, "metres");
  auto source = rule.height;
  if (!height) {
    auto const levels = measure(properties, rule.levels, "a number of levels");
    if (levels) height = *levels * rule.storey;
    source = rule.levels;
    if (height && *height > geojson::max_height) {
      throw Error(fmt::format("{} is {} of {} m each, expected a height of at most {:.0f} m",
                              source, *levels, rule.storey, geojson::max_height));
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
  for (auto const& position : positions)
    ring.push_back(geojson::read_position(position, coordinates));
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

void read_parts(geojson::Feature const& feature, HeightRule const& heights,
                MapCoordinates const& coordinates, Building& building) {
  add_areas(feature.geometry, coordinates, building.parts);
  if (building.parts.empty()) return;
  double const height = height_of(feature.properties, heights);
  double const base = measure(feature.properties, "min_height", "metres").value_or(0.0);
  if (base >= height) {
    throw Error(
        fmt::format("min_height is {} m, expected less than its height of {} m", base, height));
  }
  for (auto& part : building.parts) {
    part.base = base;
    part.top = height;
  }
}

}  // namespace

BuildingFile read_buildings(std::filesystem::path const& path, HeightRule const& heights,
                            std::optional<MapCoordinates> const& coordinates,
                            std::optional<geojson::Nearby> const& nearby) {
  BuildingFile file;
  file.coordinates = geojson::read_features(
      path, coordinates, nearby, [&](geojson::Feature const& feature, MapCoordinates const& used) {
        Building building{feature.name, feature.label, {}};
        read_parts(feature, heights, used, building);
        if (building.parts.empty()) {
          ++file.others;
        } else {
          file.buildings.push_back(std::move(building));
        }
      });
  if (file.buildings.empty() && !nearby) {
    throw Error(fmt::format("{}: has no Polygon or MultiPolygon", path.string()));
  }
  return file;
}

}  // namespace gpu_shading::energyplus
