#include "reports/map_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {
namespace {

using Json = nlohmann::json;

Json ring_to_json(Ring const& ring) {
  Json json = Json::array();
  for (auto const& point : ring) json.push_back({point.x, point.y, point.z});
  return json;
}

Ring ring_of(Json const& json) {
  Ring ring;
  for (auto const& point : json) ring.emplace_back(point.at(0), point.at(1), point.at(2));
  return ring;
}

Json map_to_json(ReceiverMap const& map) {
  Json holes = Json::array();
  for (auto const& hole : map.polygon.holes) holes.push_back(ring_to_json(hole));
  Json values = Json::array();
  for (auto const& value : map.values) values.push_back({value.hours, value.energy});
  return {{"name", map.name},
          {"outline", ring_to_json(map.polygon.outline)},
          {"holes", std::move(holes)},
          {"values", std::move(values)}};
}

ReceiverMap map_of(Json const& json) {
  ReceiverMap map{json.at("name"), {ring_of(json.at("outline")), {}}, {}};
  for (auto const& hole : json.at("holes")) map.polygon.holes.push_back(ring_of(hole));
  for (auto const& value : json.at("values")) map.values.push_back({value.at(0), value.at(1)});
  return map;
}

}  // namespace

void write_maps(std::filesystem::path const& file, std::vector<ReceiverMap> const& maps) {
  Json json = Json::array();
  for (auto const& map : maps) json.push_back(map_to_json(map));
  auto const bytes = Json::to_cbor(json);
  write_whole_file(file, [&](std::ostream& out) {
    out.write(reinterpret_cast<char const*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
  });
}

std::vector<ReceiverMap> read_maps(std::filesystem::path const& file) {
  auto const bytes = read_text_file(file);
  try {
    std::vector<ReceiverMap> maps;
    for (auto const& json : Json::from_cbor(bytes)) maps.push_back(map_of(json));
    return maps;
  } catch (Json::exception const& error) {
    throw Error(
        fmt::format("{}: is not a file of gpu_shading's own ({})", file.string(), error.what()));
  }
}

}  // namespace gpu_shading::energyplus
