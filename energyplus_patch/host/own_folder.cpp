#include "host/own_folder.h"

namespace gpu_shading::energyplus {

std::filesystem::path own_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

}  // namespace gpu_shading::energyplus
