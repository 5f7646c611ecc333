#include "host/given_choices.h"

#include <fmt/format.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// Lines where there are any (their flags may hold blanks), else words.
std::vector<std::string> split(std::string const& options) {
  std::istringstream text(options);
  if (options.find('\n') == std::string::npos) {
    return {std::istream_iterator<std::string>(text), {}};
  }
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace

Choices given_choices(char const* flags) {
  auto arguments = split(flags == nullptr ? "" : flags);
  auto choices = take_flags(arguments);
  if (!arguments.empty()) throw Error(fmt::format("{}: no such flag", arguments.front()));
  choices.fill_from(read_environment());
  return choices;
}

}  // namespace gpu_shading::energyplus
