#pragma once

#include <filesystem>
#include <string>

#include "samples/sample_parts.h"

namespace gpu_shading::energyplus {

// What `gpu_shading sample` wants of a session in EnergyPlus; how the sun is sampled is among the
// session's own options.
struct SampleRequest {
  std::string asked;      // for SampledScene
  double latitude = 0.0;  // radians
  std::filesystem::path parts;
  Shard shard;
  int progress = -1;  // the file descriptor that tells how far it is; none where it is negative
  std::filesystem::path done;  // gets one line on what was done, at the end
};

SampleRequest read_sample_request(std::filesystem::path const& file);
void write_sample_request(std::filesystem::path const& file, SampleRequest const& request);

}  // namespace gpu_shading::energyplus
