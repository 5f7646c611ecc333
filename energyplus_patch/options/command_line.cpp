#include "options/command_line.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace gpu_shading::energyplus {

CommandLine read_command_line(std::vector<std::string> const& arguments) {
  // EnergyPlus 25.2 --help
  constexpr std::array<std::string_view, 12> with_value{
      "-d", "--output-directory", "-i", "--idd",     "-p", "--output-prefix",
      "-s", "--output-suffix",    "-w", "--weather", "-j", "--jobs"};
  CommandLine line;
  bool no_run = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    auto const& argument = arguments[i];
    if (std::find(with_value.begin(), with_value.end(), argument) != with_value.end()) {
      ++i;
      if ((argument == "-w" || argument == "--weather") && i < arguments.size()) {
        line.weather = arguments[i];
      }
    } else if (argument == "-h" || argument == "--help") {
      line.help = true;
    } else if (argument == "-v" || argument == "--version") {
      line.version = true;
    } else if (argument == "auxiliary") {
      no_run = true;
    } else if (argument == "-m" || argument == "--epmacro") {
      line.preprocessed = true;
    } else if (argument == "-x" || argument == "--expandobjects") {
      line.expand = true;
    } else if (argument == "-c" || argument == "--convert" || argument == "--convert-only") {
      line.convert = true;
    } else if (argument == "-a" || argument == "--annual") {
      line.annual = true;
    } else if (argument == "-D" || argument == "--design-day") {
      line.design_days = true;
    } else if (!argument.starts_with("-")) {
      line.model = argument;
      line.model_at = i;
    }
  }
  if (!line.model) line.model = "in.idf";
  if (line.preprocessed || no_run || line.help || line.version) line.model.reset();
  return line;
}

}  // namespace gpu_shading::energyplus
