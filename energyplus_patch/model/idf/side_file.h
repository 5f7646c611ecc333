#pragma once

#include <filesystem>
#include <vector>

#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

// The extension objects of a file of their own, IDF or epJSON, with or without a Version. All of it
// is read or Error thrown, which names the file: where there is anything else in it, an object
// without its semicolon, or text that is not UTF-8. A byte order mark and line ends of every kind
// are accepted.
std::vector<InputObject> read_side_file(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus
