#pragma once

#include <filesystem>
#include <utility>

namespace gpu_shading::energyplus {

// Which image and mesh files are read.
enum class Assets {
  restricted,  // in the formats that the documents list; what they name, from their folder
  any,         // in all formats of OpenImageIO and Assimp, with files in any folder
};

// Where the relative file names of a model start.
struct AssetFolder {
  // Implicit: most callers have the folder alone.
  // NOLINTNEXTLINE(google-explicit-constructor)
  AssetFolder(std::filesystem::path folder = {}, Assets kind = Assets::restricted)
      : path(std::move(folder)), assets(kind) {}

  std::filesystem::path path;
  Assets assets;
};

}  // namespace gpu_shading::energyplus
