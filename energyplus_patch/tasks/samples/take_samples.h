#pragma once

#include <string>

#include "gpu_shading/sampled_sunlit.h"
#include "tasks/samples/sample_parts.h"
#include "tasks/samples/sample_request.h"

namespace gpu_shading::energyplus {

// Renders samples into parts. A single shard goes through all rounds. One of several renders its
// share of the first round that lacks it, once all shares of the earlier rounds are there. Existing
// parts are not rendered again; parts of other scenes count as missing and are replaced. Returns
// one line on what was done and what to do next. Throws Error and what `source` throws.
std::string take_samples(SampleRequest const& request, Sampling sampling, SampledScene const& scene,
                         std::string const& device, SunlitSource const& source);

}  // namespace gpu_shading::energyplus
