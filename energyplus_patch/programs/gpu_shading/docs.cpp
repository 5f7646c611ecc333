#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "gpu_shading/error.h"
#include "platform/console.h"
#include "platform/process.h"
#include "programs/gpu_shading/commands.h"
#include "programs/gpu_shading/share_folder.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

Path find_manual() {
  for (auto const& share : share_folders()) {
    auto const installed = share.parent_path() / "doc" / "energyplus-gpu-shading" / "html";
    for (auto const& folder : {installed, share / "out" / "site"}) {
      auto page = folder / "index.html";
      std::error_code error;
      if (std::filesystem::is_regular_file(page, error)) return page;
    }
  }
  // The pages that the site is made of, which the sources have.
  for (auto const& share : share_folders()) {
    auto page = share / "energyplus_patch" / "docs" / "README.md";
    std::error_code error;
    if (std::filesystem::is_regular_file(page, error)) return page;
  }
  throw Error(
      "the manual is not installed: install the wheel or the Debian package, or run "
      "scripts/dev/build_site in the sources");
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
