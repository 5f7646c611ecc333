#include "tasks/samples/direction_fractions.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "gpu_shading/error.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {

using Json = nlohmann::json;

void write_fractions(std::filesystem::path const& file,
                     std::vector<ReceiverFractions> const& receivers) {
  Json json = Json::array();
  for (auto const& [receiver, fractions] : receivers) {
    auto const& area = receiver.area;
    json.push_back({receiver.name, area.x, area.y, area.z, Json(fractions)});
  }
  auto const bytes = Json::to_cbor(json);
  write_whole_file(file, [&](std::ostream& out) {
    out.write(reinterpret_cast<char const*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
  });
}

std::vector<ReceiverFractions> read_fractions(std::filesystem::path const& file) {
  auto const bytes = read_text_file(file);
  try {
    std::vector<ReceiverFractions> receivers;
    for (auto const& json : Json::from_cbor(bytes)) {
      receivers.push_back({{json.at(0), {json.at(1), json.at(2), json.at(3)}}, json.at(4)});
    }
    return receivers;
  } catch (Json::exception const& error) {
    throw Error(
        fmt::format("{}: is not a file of gpu_shading's own ({})", file.string(), error.what()));
  }
}

}  // namespace gpu_shading::energyplus
