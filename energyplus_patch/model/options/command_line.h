#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// The parts of EnergyPlus's command line that the launcher needs.
struct CommandLine {
  // Empty if a preprocessor creates it, or if there is no run.
  std::optional<std::filesystem::path> model;
  std::optional<std::size_t> model_at;           // its index in the arguments, if it is one of them
  std::optional<std::filesystem::path> weather;  // -w
  bool expand = false;                           // -x
  bool annual = false;                           // -a
  bool design_days = false;                      // -D
  bool preprocessed = false;                     // -m
  bool convert = false;                          // -c and --convert-only
  bool runs = true;                              // false for --help, --version and auxiliary
  // The names of EnergyPlus's files: see its --help.
  std::filesystem::path output_folder = ".";  // -d
  std::string output_prefix = "eplus";        // -p
  std::string output_suffix = "L";            // -s
  bool help = false;
  bool version = false;
};

// `arguments`: without the program's name and our flags.
CommandLine read_command_line(std::vector<std::string> const& arguments);

}  // namespace gpu_shading::energyplus
