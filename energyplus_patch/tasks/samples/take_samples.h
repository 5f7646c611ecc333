#pragma once

#include <filesystem>
#include <string>

#include "gpu_shading/sampled_sunlit.h"
#include "tasks/samples/sample_parts.h"

namespace gpu_shading::energyplus {

// Samples of a session in EnergyPlus, and where to; their density is among the session's own
// options.
struct SampleRequest {
  std::string asked;      // for SampledScene
  double latitude = 0.0;  // radians
  std::filesystem::path parts;
  Shard shard;
  int progress = -1;  // the file descriptor for progress; none if negative
  double wait = 0.0;  // s, for the other shards of a round

  bool operator==(SampleRequest const&) const = default;
};

// Renders samples into parts. A single shard goes through all rounds. One of several renders its
// share of the first round that lacks it, once all shares of the earlier rounds are there; if it
// may wait for the other shares, it goes on with the next round. Existing parts are not rendered
// again; parts of other scenes count as missing and are replaced. Returns one line on what was done
// and what to do next. Throws Error and what `source` throws.
std::string take_samples(SampleRequest const& request, Sampling sampling, SampledScene const& scene,
                         std::string const& device, SunlitSource const& source);

}  // namespace gpu_shading::energyplus
