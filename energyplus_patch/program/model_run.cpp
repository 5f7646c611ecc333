#include "program/model_run.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

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

std::string read_text(Path const& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// The last error of ours that a run has printed, '' where there is none.
std::string own_error(Path const& log) {
  constexpr std::string_view mark = "gpu_shading: error: ";
  std::ifstream file(log);
  std::string found;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(mark, 0) == 0) found = line.substr(mark.size());
  }
  return found;
}

}  // namespace

void run_to_shading(ModelRun const& run, std::vector<std::string> const& environment,
                    Path const& folder, Path const& product) {
  auto const& [model, weather, choices] = run;
  if (!std::filesystem::exists(model)) {
    throw Error(fmt::format("{}: no such file", model.string()));
  }
  if (!is_idf(model) && !is_epjson(model)) {
    throw Error(fmt::format("{}: expected an .idf or .epJSON file", model.string()));
  }
  check_supported(read_model(model, choices).shading, read_version(own_folder()));

  auto const log = folder / "log.txt";
  std::vector<std::string> command{find_launcher().string(),
                                   "--gpu-shading",
                                   "-d",
                                   folder.string(),
                                   "-w",
                                   weather.value_or(some_weather()).string()};
  if (choices.device) command.push_back("--gpu-shading-device=" + name_of(*choices.device));
  if (choices.file) command.push_back("--gpu-shading-file=" + choices.file->string());
  if (choices.lean) command.push_back("--gpu-shading-lean=" + name_of(*choices.lean));
  if (is_idf(model) && read_text(model).find("HVACTemplate:") != std::string::npos) {
    command.emplace_back("-x");
  }
  command.push_back(model.string());
  run_process(command, environment, log);
  if (std::filesystem::exists(product)) return;
  if (auto const error = own_error(log); !error.empty()) throw Error(error);
  throw Error(fmt::format("{}: EnergyPlus does not get as far as its shading calculation:{}",
                          model.string(), stop_reasons(folder)));
}

}  // namespace gpu_shading::energyplus
