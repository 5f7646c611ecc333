#pragma once

#include <filesystem>

#include "idf/model_editor.h"

namespace gpu_shading::energyplus {

// Lets a model that is written into `folder` find the files that it names relative to the folder
// of `original`: by links or, on Windows, where links need privileges, by copies. Throws Error if a
// file cannot be copied.
void bring_named_files(ModelEditor& model, std::filesystem::path const& original,
                       std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
