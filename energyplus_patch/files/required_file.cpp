#include "files/required_file.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

void require_file(std::filesystem::path const& path) {
  if (!std::filesystem::exists(path)) throw Error(fmt::format("{}: no such file", path.string()));
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(fmt::format("{}: is not a file", path.string()));
  }
}

}  // namespace gpu_shading::energyplus
