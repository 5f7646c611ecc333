#include "program/model_run.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <string_view>

#include "files/required_file.h"
#include "files/text_file.h"
#include "gpu_shading/error.h"
#include "host/own_folder.h"
#include "host/version.h"
#include "input/model_reader.h"
#include "program/launcher.h"
#include "program/process.h"
#include "program/stop_reasons.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// Any will do: only the geometry is wanted.
Path some_weather() {
  auto const folder = own_folder() / "WeatherData";
  if (std::filesystem::exists(folder)) {
    for (auto const& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".epw") return entry.path();
    }
  }
  throw Error(fmt::format("{}: no weather file; name one with -w", folder.string()));
}

// What a run has printed of ours: "warning" or "error".
std::vector<std::string> own_messages(Path const& log, std::string_view kind) {
  auto const mark = fmt::format("gpu_shading: {}: ", kind);
  std::ifstream file(log);
  std::vector<std::string> found;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(mark)) continue;
    if (line.ends_with(':')) line.pop_back();  // a list follows
    found.push_back(line.substr(mark.size()));
  }
  return found;
}

// Of our flags those that EnergyPlus is run by here: rendering is on, and in its own process.
std::string flags_of(Choices choices) {
  if (choices.mode != Mode::require) choices.mode = Mode::automatic;
  choices.method = Method::patched;
  return to_flags(choices);
}

}  // namespace

std::vector<std::string> run_to_shading(ModelRun const& run,
                                        std::vector<std::string> const& environment,
                                        Path const& folder, Path const& product) {
  auto const& [model, weather, choices] = run;
  require_file(model);
  if (!is_idf(model) && !is_epjson(model)) {
    throw Error(fmt::format("{}: expected an .idf or .epJSON file", model.string()));
  }
  check_supported(read_model(model, choices).shading, read_version(own_folder()));

  auto const log = folder / "log.txt";
  std::vector<std::string> command{find_launcher().string(), "-d", folder.string(), "-w",
                                   (weather ? *weather : some_weather()).string()};
  std::istringstream flags(flags_of(choices));
  for (std::string flag; std::getline(flags, flag);) command.push_back(flag);
  if (is_idf(model) && read_text_file(model).find("HVACTemplate:") != std::string::npos) {
    command.emplace_back("-x");
  }
  command.push_back(model.string());
  run_process(command, environment, log);
  if (std::filesystem::exists(product)) return own_messages(log, "warning");
  if (auto const errors = own_messages(log, "error"); !errors.empty()) throw Error(errors.back());
  throw Error(fmt::format("{}: EnergyPlus does not get as far as its shading calculation:{}",
                          model.string(), stop_reasons(folder)));
}

}  // namespace gpu_shading::energyplus
