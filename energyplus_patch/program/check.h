#pragma once

#include "program/model_run.h"

namespace gpu_shading::energyplus {

// Reads a model and its extensions and prints what each surface will be to the shading calculation,
// and every error. The surfaces come from EnergyPlus itself, run as far as it hands them over.
// `vertices`: prints their vertices, in world axes, instead. Throws Error.
void check(ModelRun const& run, bool vertices);

}  // namespace gpu_shading::energyplus
