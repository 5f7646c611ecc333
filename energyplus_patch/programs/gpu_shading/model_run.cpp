#include "programs/gpu_shading/model_run.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/idf/model_text.h"
#include "platform/files.h"
#include "platform/process.h"
#include "runs/installation.h"
#include "runs/refused_run.h"
#include "tasks/task_file.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// Any weather file works, because only the geometry is used.
Path some_weather() {
  auto const folder = find_launcher().parent_path() / "WeatherData";
  if (std::filesystem::exists(folder)) {
    for (auto const& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".epw") return entry.path();
    }
  }
  throw Error(fmt::format("{}: no weather file; name one with -w", folder.string()));
}

// The flags with which EnergyPlus is run here.
std::vector<std::string> flags_of(Choices choices, Path const& task) {
  if (!choices.mode) choices.mode = Mode::automatic;
  if (choices.method == Method::scheduled) choices.method = Method::automatic;
  choices.task = task;
  return to_flags(choices);
}

// The command that runs EnergyPlus for a task.
std::vector<std::string> command_for(ModelRun const& run, Path const& task, Path const& folder) {
  auto const& [model, weather, choices] = run;
  auto const epw = weather ? *weather : some_weather();
  std::vector<std::string> command{find_launcher().string(), "-d", folder.string(), "-w",
                                   epw.string()};
  for (auto const& flag : flags_of(choices, task)) command.push_back(flag);
  if (is_idf(model) && !find_template(parse_idf(read_text_file(model))).empty()) {
    command.emplace_back("-x");
  }
  command.push_back(model.string());
  return command;
}

}  // namespace

TaskReply run_task(ModelRun const& run, Task const& task) {
  auto const& model = run.model;
  require_model(model);
  if (run.choices.mode == Mode::off) {
    throw Error(
        "--gpu-shading (or GPU_SHADING) is off, but this command renders: expected auto or "
        "require");
  }
  TemporaryFolder const folder;
  auto const request = folder.path() / "task";
  auto const reply = folder.path() / "reply";
  auto const log = folder.path() / "log.txt";
  write_request(request, {task, reply});
  int const status = run_process(command_for(run, request, folder.path()), {}, log);
  if (auto found = find_reply(reply)) {
    if (!found->error.empty()) throw Error(found->error);
    return std::move(*found);
  }
  if (auto const error = last_error(log)) throw Error(*error);
  require_room(folder.path());
  throw Error(fmt::format("{}: EnergyPlus stopped before its shading calculation ({}): {}",
                          model.string(), describe_status(status), stop_reasons(folder.path())));
}

}  // namespace gpu_shading::energyplus
