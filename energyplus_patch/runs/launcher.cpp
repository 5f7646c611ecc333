#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "platform/process.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {

std::filesystem::path find_launcher() {
  auto launcher = own_folder() / "energyplus";
  if (!std::filesystem::exists(own_folder() / "libenergyplusapi.so")) {
    throw Error(
        fmt::format("{}: is not a patched EnergyPlus; run gpu_shading from a folder created by "
                    "patch_energyplus",
                    own_folder().string()));
  }
  find_energyplus_library(own_folder());
  return launcher;
}

}  // namespace gpu_shading::energyplus
