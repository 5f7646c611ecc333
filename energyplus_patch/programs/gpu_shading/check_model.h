#pragma once

#include "programs/gpu_shading/model_run.h"

namespace gpu_shading::energyplus {

// Reads a model and its extensions, and prints how each surface takes part in the shading
// calculation, or every error. The surfaces come from EnergyPlus itself, which runs until it has
// passed them. Throws Error.
void check(ModelRun const& run, ListingTask const& task);

}  // namespace gpu_shading::energyplus
