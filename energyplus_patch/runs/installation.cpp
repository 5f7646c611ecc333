#include "runs/installation.h"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <string_view>

#include "base/process.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

namespace {

// libenergyplusapi.so.25.2.0, for a build without the data dictionary.
std::optional<std::string> version_of_library(std::filesystem::path const& folder) {
  constexpr std::string_view start = "libenergyplusapi.so.";
  for (auto const& entry : std::filesystem::directory_iterator(folder)) {
    auto const name = entry.path().filename().string();
    if (name.starts_with(start)) return name.substr(start.size());
  }
  return std::nullopt;
}

}  // namespace

std::string read_version(std::filesystem::path const& folder) {
  constexpr std::string_view mark = "!IDD_Version ";
  auto const idd = folder / "Energy+.idd";
  if (!std::filesystem::exists(idd)) {
    if (auto const version = version_of_library(folder)) return *version;
  }
  std::ifstream file(idd);
  std::string line;
  std::getline(file, line);
  if (!line.starts_with(mark)) {
    throw Error(fmt::format("{}: is not an EnergyPlus input data dictionary", idd.string()));
  }
  return line.substr(mark.size(), line.find_last_not_of(" \r") + 1 - mark.size());
}

std::filesystem::path find_launcher() {
  auto launcher = own_folder() / "energyplus";
  if (!std::filesystem::exists(own_folder() / "libenergyplusapi.so")) {
    throw Error(
        fmt::format("{}: is not a patched EnergyPlus; run gpu_shading from a folder created by "
                    "patch_energyplus",
                    own_folder().string()));
  }
  return launcher;
}

}  // namespace gpu_shading::energyplus
