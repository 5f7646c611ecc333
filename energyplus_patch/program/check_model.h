#pragma once

#include "program/model_run.h"

namespace gpu_shading::energyplus {

// Reads a model and its extensions, and prints how each surface takes part in the shading
// calculation, or every error. The surfaces come from EnergyPlus itself, which runs until it has
// passed them. `vertices`: print their vertices in world axes instead. Throws Error.
void check(ModelRun const& run, bool vertices);

}  // namespace gpu_shading::energyplus
