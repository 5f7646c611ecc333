#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/process.h"
#include "programs/gpu_shading/commands.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// The command of the Python package, which a patched folder has a link to, and an installation
// beside its libexec.
Path find_command(std::string const& name) {
  auto const folder = own_folder();
  std::array const places{folder / "gpu_shading_python",
                          folder.parent_path().parent_path() / "lib" / "python3" / "dist-packages"};
  for (auto const& place : places) {
    auto file = place / "gpu_shading" / name / "__main__.py";
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error)) return file;
  }
  throw Error(fmt::format("{}: the Python package is not in {}: run patch_energyplus again", name,
                          fmt::join(std::array{places[0].string(), places[1].string()}, " or ")));
}

// Their names, and what they do.
constexpr std::array<std::pair<char const*, char const*>, 2> python_commands{
    {{"study",
      "Run a plan of models, variants and weather files on many workers, with a table of results "
      "(needs Python with Dask)"},
     {"suite",
      "Score shading tools on scenes with exact sunlit fractions (needs Python with NumPy)"}}};

}  // namespace

void add_python_commands(Program const& program) {
  // Never parsed: run_python_command() takes their place.
  for (auto const& [name, description] : python_commands) {
    Command const command(program, name, description, {});
  }
}

bool is_python_command(std::string const& name) {
  return std::ranges::any_of(python_commands,
                             [&](auto const& command) { return command.first == name; });
}

void run_python_command(std::string const& name, std::vector<std::string> const& arguments) {
  auto const own = own_folder();
  if (get_variable("GPU_SHADING_PREFIX").empty() &&
      std::filesystem::exists(own / ".gpu_shading_prefix.json")) {
    set_variable("GPU_SHADING_PREFIX", own.string());
  }
  std::vector<std::string> words{"python3", find_command(name).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv(words.size() + 1, nullptr);
  std::ranges::transform(words, argv.begin(), [](std::string& word) { return word.data(); });
  execvp(argv.front(), argv.data());
  throw Error(fmt::format("{}: python3: {}", name, std::strerror(errno)));
}

}  // namespace gpu_shading::energyplus
