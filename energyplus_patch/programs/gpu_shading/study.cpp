#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/process.h"
#include "programs/gpu_shading/commands.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// The command of the Python package, which a patched folder has a link to, and an installation
// beside its libexec.
Path find_command() {
  auto const folder = own_folder();
  std::array const places{folder / "gpu_shading_python",
                          folder.parent_path().parent_path() / "lib" / "python3" / "dist-packages"};
  for (auto const& place : places) {
    auto file = place / "gpu_shading" / "study" / "__main__.py";
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error)) return file;
  }
  throw Error(fmt::format("study: the Python package is not in {}: run patch_energyplus again",
                          fmt::join(std::array{places[0].string(), places[1].string()}, " or ")));
}

}  // namespace

void add_study(Program const& program) {
  // Never parsed: run_study() takes its place.
  Command const command(program, "study",
                        "Run a plan of models, variants and weather files on many workers, with a "
                        "table of results (needs Python with Dask)",
                        {});
}

void run_study(std::vector<std::string> const& arguments) {
  auto const own = own_folder();
  if (get_variable("GPU_SHADING_PREFIX").empty() &&
      std::filesystem::exists(own / ".gpu_shading_prefix.json")) {
    set_variable("GPU_SHADING_PREFIX", own.string());
  }
  std::vector<std::string> words{"python3", find_command().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv(words.size() + 1, nullptr);
  std::ranges::transform(words, argv.begin(), [](std::string& word) { return word.data(); });
  execvp(argv.front(), argv.data());
  throw Error(fmt::format("study: python3: {}", std::strerror(errno)));
}

}  // namespace gpu_shading::energyplus
