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

void raise(std::vector<Footprint>& parts, Json const& properties, HeightRule const& heights) {
  double const height = height_of(properties, heights);
  double const base = measure(properties, "min_height", "metres").value_or(0.0);
  if (base >= height) {
    throw Error(
        fmt::format("min_height is {} m, expected less than its height of {} m", base, height));
  }
  for (auto& part : parts) {
    part.base = base;
    part.top = height;
  }
}

}  // namespace

BuildingFile read_buildings(std::filesystem::path const& path, HeightRule const& heights,
                            std::optional<MapCoordinates> const& coordinates,
                            std::optional<geojson::Nearby> const& nearby) {
  BuildingFile file;
  file.coordinates =
      geojson::read_features(path, coordinates, nearby, [&](geojson::Feature& feature) {
        if (feature.geometry.areas.empty()) {
          ++file.others;
          return;
        }
        raise(feature.geometry.areas, feature.properties, heights);
        file.buildings.push_back(
            {std::move(feature.name), std::move(feature.label), std::move(feature.geometry.areas)});
      });
  if (file.buildings.empty() && !nearby) {
    throw Error(fmt::format("{}: has no Polygon or MultiPolygon", path.string()));
  }
  return file;
}

}  // namespace gpu_shading::energyplus
