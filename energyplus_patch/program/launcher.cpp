#include "program/launcher.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "host/own_folder.h"

namespace gpu_shading::energyplus {

std::filesystem::path find_launcher() {
  auto launcher = own_folder() / "energyplus";
  if (!std::filesystem::exists(own_folder() / "libenergyplusapi.so")) {
    throw Error(
        fmt::format("{}: is not a patched EnergyPlus; run the gpu_shading of a prefix made by "
                    "patch_energyplus",
                    own_folder().string()));
  }
  return launcher;
}

}  // namespace gpu_shading::energyplus
