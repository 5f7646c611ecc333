#include "model/site/tree_file.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/site/geojson.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

using geojson::Json;

std::optional<double> length(Json const& properties, char const* name) {
  auto const metres = geojson::measure(properties, name, "metres");
  if (metres && *metres <= 0.0) {
    throw Error(fmt::format("{} is {}, expected more than 0", name, *metres));
  }
  return metres;
}

// Others than OpenStreetMap's own words are as good as none: semi_deciduous, semi_evergreen.
std::optional<bool> is_evergreen(Json const& properties) {
  auto const cycle = text_of(geojson::member(properties, "leaf_cycle"));
  if (same_name(cycle, "evergreen")) return true;
  if (same_name(cycle, "deciduous")) return false;
  return std::nullopt;
}

std::string taxon_of(Json const& properties) {
  for (auto const* name : {"genus", "species", "taxon"}) {
    auto const& value = geojson::member(properties, name);
    if (value.is_string() && !value.get<std::string>().empty()) return value.get<std::string>();
  }
  return "";
}

}  // namespace

TreeFile read_tree_file(std::filesystem::path const& path,
                        std::optional<MapCoordinates> const& coordinates) {
  constexpr std::size_t most = 100'000;
  TreeFile file;
  geojson::read_features(path, coordinates, std::nullopt, [&](geojson::Feature& feature) {
    if (feature.geometry.points.empty()) {
      ++file.others;
      return;
    }
    MappedTree tree;
    tree.name = feature.name;
    tree.height = length(feature.properties, "height");
    tree.crown_diameter = length(feature.properties, "diameter_crown");
    tree.evergreen = is_evergreen(feature.properties);
    tree.taxon = taxon_of(feature.properties);
    for (auto const& point : feature.geometry.points) {
      tree.place = point;
      if (file.trees.size() == most) throw Error(fmt::format("more than {} trees", most));
      file.trees.push_back(tree);
    }
  });
  if (file.trees.empty()) throw Error(fmt::format("{}: has no Point", path.string()));
  return file;
}

}  // namespace gpu_shading::energyplus
