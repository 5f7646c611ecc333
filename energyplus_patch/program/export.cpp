#include "program/export.h"

#include <fmt/format.h>

#include <cstdio>

#include "files/required_file.h"
#include "files/whole_file.h"
#include "gpu_shading/error.h"
#include "program/launcher.h"
#include "scheduled/scheduled_model.h"

namespace gpu_shading::energyplus {
namespace {

void say(std::string const& line) { fmt::print(stderr, "gpu_shading: {}\n", line); }

void complete(EnergyPlusCall& call) {
  require_file(call.model);
  if (!call.weather) {
    throw Error("-w: a weather file is needed, whose place and days the sun keeps to");
  }
  call.program = find_launcher();
}

}  // namespace

void export_scheduled(EnergyPlusCall call, Choices const& choices,
                      std::filesystem::path const& folder) {
  complete(call);
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder)) {
    throw Error(fmt::format("{}: exists and is not empty: choose another folder", folder.string()));
  }
  std::filesystem::create_directories(folder);
  auto const model = prepare_scheduled(call, choices, folder, say);
  fmt::print("{}\n", model.path.string());
}

void export_imported(EnergyPlusCall call, Choices const& choices,
                     std::filesystem::path const& file) {
  complete(call);
  auto const table = sunlit_fractions(call, choices, say);
  write_whole_file(file, [&](std::ostream& out) { write_imported_file(table, out); });
}

}  // namespace gpu_shading::energyplus
