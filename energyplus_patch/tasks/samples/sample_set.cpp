#include "tasks/samples/sample_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// The scene is that of the first part.
SampledScene scene_of(SampleParts const& parts, std::string const& asked) {
  auto first = parts.find(1, 1);
  auto const file = parts.file(1, 1).string();
  if (!first) throw Error(fmt::format("{}: is missing; render it first", file));
  if (first->scene.asked != asked) {
    throw Error(fmt::format("{}: belongs to {}; expected {}", file, first->scene.asked, asked));
  }
  return std::move(first->scene);
}

void add(std::vector<std::string> const& from, std::vector<std::string>& devices) {
  for (auto const& device : from) {
    if (std::find(devices.begin(), devices.end(), device) == devices.end()) {
      devices.push_back(device);
    }
  }
}

}  // namespace

SampleSet gather_samples(SampleParts const& parts, std::string const& asked, Sampling sampling,
                         double latitude) {
  auto scene = scene_of(parts, asked);
  std::vector<std::string> devices;
  std::vector<std::size_t> counts;
  SampleRounds rounds(sampling, latitude, scene.areas());
  for (int round = 1; !rounds.directions().empty(); ++round) {
    auto const found = find_round(parts, scene, round, rounds.directions());
    if (!found.missing.empty()) {
      throw Error(fmt::format(
          "{}: is missing, or belongs to another model or build; render shards {} of round {} "
          "first",
          parts.file(round, found.missing.front()).string(), list_shards(found.missing), round));
    }
    add(found.devices, devices);
    counts.push_back(rounds.directions().size());
    rounds.add(found.answers);
  }
  return {std::move(scene), std::move(devices), std::move(counts),
          SampledSunlit(std::move(rounds))};
}

}  // namespace gpu_shading::energyplus
