#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// What the launcher must know of EnergyPlus's own command line.
struct CommandLine {
  std::optional<std::filesystem::path>
      model;                            // none where it is made by a preprocessor, or not run
  std::optional<std::size_t> model_at;  // its place among the arguments, where it is one
  std::optional<std::filesystem::path> weather;  // -w
  bool expand = false;                           // -x
  bool annual = false;                           // -a
  bool design_days = false;                      // -D
  bool preprocessed = false;                     // -m
  bool help = false;
};

// `arguments`: without the program's name and without our flags.
CommandLine read_command_line(std::vector<std::string> const& arguments);

}  // namespace gpu_shading::energyplus
