#include "host/version.h"

#include <fmt/format.h>

#include <fstream>
#include <string_view>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

std::string read_version(std::filesystem::path const& folder) {
  constexpr std::string_view mark = "!IDD_Version ";
  auto const idd = folder / "Energy+.idd";
  std::ifstream file(idd);
  std::string line;
  std::getline(file, line);
  if (!line.starts_with(mark)) {
    throw Error(fmt::format("{}: is not an EnergyPlus input data dictionary", idd.string()));
  }
  return line.substr(mark.size(), line.find_last_not_of(" \r") + 1 - mark.size());
}

}  // namespace gpu_shading::energyplus
