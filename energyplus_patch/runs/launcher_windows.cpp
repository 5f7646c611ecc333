#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "platform/process.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {

std::filesystem::path find_launcher() {
  if (!std::filesystem::exists(own_folder() / "energyplus-official.exe")) {
    throw Error(
        fmt::format("{}: is not a patched EnergyPlus; run gpu_shading from a folder created by "
                    "patch_energyplus",
                    own_folder().string()));
  }
  return own_folder() / "energyplus.exe";
}

}  // namespace gpu_shading::energyplus
