#include "programs/gpu_shading/export.h"

#include <fmt/format.h>

#include <cstdio>

#include "gpu_shading/error.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/staged_files.h"
#include "routes/schedules/scheduled_run.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {
namespace {

void complete(EnergyPlusCall& call) {
  require_file(call.model);
  if (!call.weather) {
    throw Error("-w: a weather file is required (it sets site and calendar)");
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
  auto const target = std::filesystem::absolute(folder / "").parent_path();
  StagedFiles files(target.parent_path());
  auto const staged = files.add(target.filename().string());
  std::filesystem::create_directory(staged);
  auto const model = prepare_scheduled(call, choices, staged, print_line);
  files.commit();
  print_text(fmt::format("{}\n", (folder / model.path.filename()).string()));
}

void export_imported(EnergyPlusCall call, Choices const& choices,
                     std::filesystem::path const& file) {
  complete(call);
  auto const table = sunlit_fractions(call, choices, print_line);
  write_whole_file(file, [&](std::ostream& out) { write_imported_file(table, out); });
}

}  // namespace gpu_shading::energyplus
