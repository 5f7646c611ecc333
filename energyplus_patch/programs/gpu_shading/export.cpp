#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/staged_files.h"
#include "programs/gpu_shading/commands.h"
#include "routes/schedules/scheduled_run.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {
namespace {

// Writes the model with scheduled sunlit fractions, their file, and links to the files that it
// needs into a folder, for any program that runs EnergyPlus. Standard error lists what remains to
// EnergyPlus.
void export_scheduled(ModelRun const& run, EnergyPlusCall call,
                      std::filesystem::path const& folder) {
  require_file(run.model);
  if (!run.weather) throw Error("-w: a weather file is required (it sets site and calendar)");
  call.program = find_launcher();
  call.model = run.model;
  call.weather = run.weather;
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder)) {
    throw Error(fmt::format("{}: exists and is not empty: choose another folder", folder.string()));
  }
  auto const target = std::filesystem::absolute(folder / "").parent_path();
  StagedFiles files(target.parent_path());
  auto const staged = files.add(target.filename().string());
  std::filesystem::create_directory(staged);
  auto const model = prepare_scheduled(call, run.choices, staged, print_line);
  files.commit();
  print("{}\n", (folder / model.path.filename()).string());
}

}  // namespace

void add_export(Program const& program) {
  Command const command(
      program, "export",
      "Render sunlit fractions of the run periods, for an EnergyPlus without this renderer",
      {"", "error", "resolution", "update", "device", "file", "report", "cache", "cache-size",
       "cache-read-only", "threads", "quiet", "verbose", "assets"});
  auto const model = command.add_model("Weather file: site and calendar (required)");
  auto const call = std::make_shared<EnergyPlusCall>();
  auto const folder = std::make_shared<std::string>();
  command->add_flag("-x,--expandobjects", call->expand, "Run ExpandObjects first");
  command->add_flag("-a,--annual", call->annual, "Simulate a whole year, whatever the run periods");
  command
      ->add_option("--scheduled", *folder,
                   "Write the model, with its sunlit fractions as schedules, into this folder")
      ->required()
      ->type_name("DIR");
  command.run([model, call, folder] { export_scheduled(*model, *call, *folder); });
}

}  // namespace gpu_shading::energyplus
