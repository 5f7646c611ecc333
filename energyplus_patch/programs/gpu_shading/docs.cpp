#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/console.h"
#include "platform/process.h"
#include "programs/gpu_shading/commands.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// Where programs keep their data: beside this one, then in the system's folders.
std::vector<Path> data_folders() {
  std::vector<Path> folders{own_folder().parent_path().parent_path() / "share"};
  auto listed = get_variable("XDG_DATA_DIRS");
  if (listed.empty()) listed = "/usr/local/share:/usr/share";
  std::stringstream parts(listed);
  for (std::string folder; std::getline(parts, folder, ':');) folders.emplace_back(folder);
  return folders;
}

Path find_manual() {
  for (auto const& folder : data_folders()) {
    auto page = folder / "doc" / "energyplus-gpu-shading" / "html" / "index.html";
    std::error_code error;
    if (std::filesystem::is_regular_file(page, error)) return page;
  }
  throw Error(
      "the manual is not installed: install the Debian package, or run scripts/dev/build_site in "
      "the sources");
}

bool has_desktop() {
  return !get_variable("DISPLAY").empty() || !get_variable("WAYLAND_DISPLAY").empty();
}

void open_manual() {
  auto const page = find_manual();
  print_text(fmt::format("{}\n", page.string()));
  if (!has_desktop()) return;
  try {
    run_process({"/usr/bin/env", "xdg-open", page.string()}, {}, "/dev/null");
  } catch (Error const&) {
    // The path is printed, for a browser that is started by hand.
  }
}

}  // namespace

void add_docs(Program const& program) {
  Command const command(program, "docs",
                        "Print where the manual is installed, and open it in a browser where there "
                        "is a desktop",
                        {});
  command.run(open_manual);
}

}  // namespace gpu_shading::energyplus
