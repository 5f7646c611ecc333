#include "routes/schedules/scheduled_run.h"

#include "gpu_shading/error.h"
#include "model/options/command_line.h"
#include "platform/console.h"
#include "platform/process.h"
#include "routes/hosted_run.h"
#include "routes/schedules/scheduled_model.h"

namespace gpu_shading::energyplus {

int run_scheduled(std::filesystem::path const& library, Choices const& choices,
                  std::vector<std::string> arguments) {
  auto const line = read_command_line(arguments);
  if (line.preprocessed) {
    throw Error(
        "-m: sunlit fractions of an EPMacro model cannot be passed as schedules; create its IDF "
        "first");
  }
  if (!line.model) return run_hosted(library, arguments, {});
  if (!std::filesystem::exists(*line.model)) return run_hosted(library, arguments, {});
  TemporaryFolder const folder;
  auto const prepared = prepare_scheduled({own_folder() / "energyplus", *line.model, line.weather,
                                           line.expand, line.annual, line.design_days},
                                          choices, folder.path(), print_line);
  if (line.model_at) {
    arguments[*line.model_at] = prepared.path.string();
  } else {
    arguments.push_back(prepared.path.string());
  }
  return run_hosted(library, arguments, {prepared.warnings, prepared.remarks});
}

}  // namespace gpu_shading::energyplus
