#include "samples/sample_request.h"

#include <nlohmann/json.hpp>

#include "files/text_file.h"
#include "files/whole_file.h"

namespace gpu_shading::energyplus {

SampleRequest read_sample_request(std::filesystem::path const& file) {
  auto const json = nlohmann::json::parse(read_text_file(file));
  return {json.at("asked"),
          json.at("latitude"),
          json.at("parts").get<std::string>(),
          {json.at("shard"), json.at("shards")},
          json.at("progress"),
          json.at("done").get<std::string>()};
}

void write_sample_request(std::filesystem::path const& file, SampleRequest const& request) {
  nlohmann::json const json{{"asked", request.asked},          {"latitude", request.latitude},
                            {"parts", request.parts.string()}, {"shard", request.shard.number},
                            {"shards", request.shard.shards},  {"progress", request.progress},
                            {"done", request.done.string()}};
  write_whole_file(file, [&](std::ostream& out) { out << json; });
}

}  // namespace gpu_shading::energyplus
