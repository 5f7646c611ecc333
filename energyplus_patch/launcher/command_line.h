#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// What the launcher must know of EnergyPlus's own command line.
struct CommandLine {
  std::optional<std::filesystem::path>
      model;  // none where it is made by a preprocessor, or not run
  bool help = false;
};

// `arguments`: without the program's name and without our flags.
CommandLine read_command_line(std::vector<std::string> const& arguments);

}  // namespace gpu_shading::energyplus
