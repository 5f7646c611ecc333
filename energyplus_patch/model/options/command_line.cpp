#include "model/options/command_line.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace gpu_shading::energyplus {
namespace {

// An option with a value: "-d DIR", "--output-directory DIR" or "--output-directory=DIR".
struct ValueOption {
  std::string_view letter;
  std::string_view word;
};

constexpr ValueOption weather_option{"-w", "--weather"};
constexpr ValueOption folder_option{"-d", "--output-directory"};
constexpr ValueOption prefix_option{"-p", "--output-prefix"};
constexpr ValueOption suffix_option{"-s", "--output-suffix"};
// EnergyPlus's --help
constexpr std::array<ValueOption, 6> value_options{{weather_option,
                                                    folder_option,
                                                    prefix_option,
                                                    suffix_option,
                                                    {"-i", "--idd"},
                                                    {"-j", "--jobs"}}};

void set_value(ValueOption const& option, std::string const& value, CommandLine& line) {
  if (option.letter == weather_option.letter) line.weather = value;
  if (option.letter == folder_option.letter) line.output_folder = value;
  if (option.letter == prefix_option.letter) line.output_prefix = value;
  if (option.letter == suffix_option.letter) line.output_suffix = value;
}

// Reads the option at `i`, which is moved to the last of its arguments. Returns whether there is
// one.
bool read_option(std::vector<std::string> const& arguments, std::size_t& i, CommandLine& line) {
  std::string_view const argument = arguments[i];
  auto const equals = argument.find('=');
  auto const* const option = std::ranges::find_if(value_options, [&](ValueOption const& known) {
    return argument == known.letter || argument.substr(0, equals) == known.word;
  });
  if (option == value_options.end()) return false;
  if (argument != option->letter && equals != std::string_view::npos) {
    set_value(*option, std::string(argument.substr(equals + 1)), line);
  } else if (++i < arguments.size()) {
    set_value(*option, arguments[i], line);
  }
  return true;
}

}  // namespace

CommandLine read_command_line(std::vector<std::string> const& arguments) {
  CommandLine line;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    auto const& argument = arguments[i];
    if (read_option(arguments, i, line)) continue;
    if (argument == "-h" || argument == "--help") {
      line.help = true;
    } else if (argument == "-v" || argument == "--version") {
      line.version = true;
    } else if (argument == "auxiliary") {
      line.runs = false;
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
  if (line.help || line.version) line.runs = false;
  if (line.preprocessed || !line.runs) line.model.reset();
  return line;
}

}  // namespace gpu_shading::energyplus
