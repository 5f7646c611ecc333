#include "runs/stop_reasons.h"

#include <fstream>

namespace gpu_shading::energyplus {

std::string stop_reasons(std::filesystem::path const& folder) {
  std::ifstream file(folder / "eplusout.err");
  std::string found;
  bool severe = false;
  for (std::string line; std::getline(file, line);) {
    bool const continued = line.find("**   ~~~   **") != std::string::npos;
    bool const starts =
        line.find("** Severe") != std::string::npos || line.find("**  Fatal") != std::string::npos;
    severe = starts || (continued && severe);
    if (severe) found += "\n" + line;
  }
  return found;
}

}  // namespace gpu_shading::energyplus
