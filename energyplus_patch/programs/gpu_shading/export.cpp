#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/staged_files.h"
#include "programs/gpu_shading/commands.h"
#include "reports/view_factors.h"
#include "routes/schedules/scheduled_run.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {
namespace {

// Writes the model with scheduled sunlit fractions, their file, and links to the files that it
// needs into a folder, for any program that runs EnergyPlus. Standard error lists what remains to
// EnergyPlus.
void export_scheduled(ModelRun const& run, EnergyPlusCall call,
                      std::filesystem::path const& folder) {
  require_model(run.model);
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

constexpr int default_rays = 65536;

// Writes EnergyPlus's objects with view factors, and a table of them beside.
void export_surroundings(ModelRun const& run, std::filesystem::path const& file, int rays) {
  if (!is_idf(file) && !is_epjson(file)) {
    throw Error(fmt::format("--surroundings {}: expected an .idf or .epJSON file", file.string()));
  }
  auto const target = std::filesystem::absolute(file);
  StagedFiles files(target.parent_path());
  auto table = target.filename();
  table.replace_extension(".csv");
  StandardError const progress;
  SurroundingsTask const task{rays, files.add(target.filename().string()),
                              files.add(table.string()), progress.descriptor()};
  auto const reply = run_task(run, task);
  for (auto const& warning : reply.warnings) print_line("warning: " + warning);
  print_line(reply.text);
  files.commit();
  print("{}\n", file.string());
}

}  // namespace

void add_export(Program const& program) {
  Command const command(
      program, "export",
      "Write sunlit fractions of the run periods, or view factors for long-wave exchange, for an "
      "EnergyPlus without this renderer",
      {"", "error", "resolution", "update", "device", "file", "report", "cache", "cache-size",
       "cache-read-only", "threads", "quiet", "verbose", "assets", "positions"});
  auto const model =
      command.add_model("Weather file: site and calendar (required with --scheduled)");
  auto const call = std::make_shared<EnergyPlusCall>();
  auto const folder = std::make_shared<std::string>();
  auto const file = std::make_shared<std::string>();
  auto const rays = std::make_shared<int>(default_rays);
  command->add_flag("-x,--expandobjects", call->expand, "Run ExpandObjects first");
  command->add_flag("-a,--annual", call->annual, "Simulate a whole year, whatever the run periods");
  auto* const what = command->add_option_group("what");
  what->add_option("--scheduled", *folder,
                   "Write the model, with its sunlit fractions as schedules, into this folder")
      ->type_name("DIR");
  what->add_option("--surroundings", *file,
                   "Write SurfaceProperty:LocalEnvironment, :SurroundingSurfaces and "
                   ":GroundSurfaces of exterior surfaces, with view factors, into this .idf or "
                   ".epJSON file, and a table of them as .csv")
      ->type_name("FILE");
  what->require_option(1);
  constexpr int max_rays = 1 << 24;
  command->add_option("--rays", *rays, "Rays from a receiver, for view factors, in steps of 16")
      ->check(CLI::Range(view_factor_batches, max_rays))
      ->capture_default_str()
      ->type_name("N");
  command.run([model, call, folder, file, rays] {
    if (file->empty()) {
      export_scheduled(*model, *call, *folder);
    } else {
      export_surroundings(*model, *file, *rays / view_factor_batches * view_factor_batches);
    }
  });
}

}  // namespace gpu_shading::energyplus
