#pragma once

#include <string>
#include <vector>

#include "gpu_shading/sampled_sunlit.h"
#include "tasks/samples/sample_parts.h"

namespace gpu_shading::energyplus {

// All parts of a scene's samples, merged.
struct SampleSet {
  SampledScene scene;
  std::vector<std::string> devices;  // devices that rendered, each once
  std::vector<std::size_t> rounds;   // directions of each
  SampledSunlit samples;
};

// Latitude in radians. Renders nothing. Throws Error if a part is missing, or belongs to another
// request or another scene.
SampleSet gather_samples(SampleParts const& parts, std::string const& asked, Sampling sampling,
                         double latitude);

}  // namespace gpu_shading::energyplus
