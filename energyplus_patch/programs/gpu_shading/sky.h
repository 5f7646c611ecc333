#pragma once

#include <filesystem>

#include "programs/gpu_shading/model_run.h"

namespace gpu_shading::energyplus {

// Renders the sunlit fraction of every receiver for each patch of three divisions of the sky, and
// writes sky.csv and sky_view.csv, with view factors to the sky, into a folder. Throws Error.
void sample_sky(ModelRun const& run, std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
