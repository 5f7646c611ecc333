#include "programs/energyplus/expansion_folder.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <system_error>

namespace gpu_shading::energyplus {
namespace {

struct FileOption {
  std::string_view letter;
  std::string_view word;
};

constexpr FileOption output_folder{"-d", "--output-directory"};
constexpr std::array<FileOption, 3> file_options{
    {output_folder, {"-i", "--idd"}, {"-w", "--weather"}}};

std::string absolute(std::string const& path) {
  return path.empty() ? path : std::filesystem::absolute(path).string();
}

// Returns whether the option is there. EnergyPlus takes "-d DIR", "--output-directory DIR" and
// "--output-directory=DIR".
bool make_absolute(FileOption const& option, std::vector<std::string>& arguments) {
  bool found = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    auto& argument = arguments[i];
    auto const with_value = fmt::format("{}=", option.word);
    if (argument == option.letter || argument == option.word) {
      if (++i < arguments.size()) arguments[i] = absolute(arguments[i]);
    } else if (argument.starts_with(with_value)) {
      argument.replace(with_value.size(), std::string::npos,
                       absolute(argument.substr(with_value.size())));
    } else {
      continue;
    }
    found = true;
  }
  return found;
}

}  // namespace

ExpansionFolder::ExpansionFolder(std::vector<std::string>& arguments, CommandLine const& line)
    : start_(std::filesystem::current_path()) {
  auto const model = absolute(line.model->string());
  if (line.model_at) arguments[*line.model_at] = model;
  for (auto const& option : file_options) {
    if (make_absolute(option, arguments)) continue;
    if (option.letter == output_folder.letter) {
      arguments.insert(arguments.end(), {std::string(option.letter), start_.string()});
    } else if (auto const usual = start_ / "in.epw";
               option.word == "--weather" && std::filesystem::exists(usual)) {
      arguments.insert(arguments.end(), {std::string(option.letter), usual.string()});
    }
  }
  if (!line.model_at) arguments.push_back(model);
  std::filesystem::current_path(folder_.path());
}

ExpansionFolder::~ExpansionFolder() {
  std::error_code ignored;
  std::filesystem::current_path(start_, ignored);
}

}  // namespace gpu_shading::energyplus
