#pragma once

#include <filesystem>

#include "model/idf/model_editor.h"

namespace gpu_shading::energyplus {

// Lets a model that is written into `folder` find the files that EnergyPlus reads for it in the
// folder of `original`: those that it names, what its Python plugins may import, and the choices
// of outputs under its name (-r). By links or, on Windows, where links need privileges, by copies
// of what it names. Throws Error if a file cannot be copied.
void bring_named_files(ModelEditor& model, std::filesystem::path const& original,
                       std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
