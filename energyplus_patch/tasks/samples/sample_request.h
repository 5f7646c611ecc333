#pragma once

#include <filesystem>
#include <string>

#include "tasks/samples/sample_parts.h"

namespace gpu_shading::energyplus {

// What is sampled of a session in EnergyPlus, and where to; how densely is among the session's own
// options.
struct SampleRequest {
  std::string asked;      // for SampledScene
  double latitude = 0.0;  // radians
  std::filesystem::path parts;
  Shard shard;
  int progress = -1;  // the file descriptor for progress; none if negative

  bool operator==(SampleRequest const&) const = default;
};

}  // namespace gpu_shading::energyplus
