#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/options/command_line.h"
#include "model/options/options.h"
#include "platform/console.h"
#include "platform/error_line.h"
#include "platform/process.h"
#include "routes/hosted_run.h"
#include "routes/opengl/opengl_run.h"
#include "routes/schedules/scheduled_run.h"
#include "runs/refused_run.h"

// Runs EnergyPlus in this process for energyplus.exe of ours, which has loaded this library.

namespace gpu_shading::energyplus {
namespace {

constexpr char const* energyplus_library = "energyplusapi.dll";
constexpr char const* official_program = "energyplus-official.exe";
constexpr int not_wanted = -1;

// `arguments`: our flags are taken out.
int run(std::vector<std::string>& arguments) {
  auto choices = take_flags(arguments);
  auto const environment = read_environment();
  auto const line = read_command_line(arguments);
  if (!choices.any() && !environment.mode) {
    if (line.help) std::fputs(help_hint, stdout);
    return not_wanted;
  }
  choices.fill_from(environment);
  apply_to_process(choices);
  auto const library = own_folder() / energyplus_library;
  if (line.help) std::fputs(options_help().c_str(), stdout);
  if (line.preprocessed) {
    throw Error("-m: an EPMacro model cannot be rendered on Windows; create its IDF first");
  }
  bool const readable = line.model && std::filesystem::exists(*line.model) &&
                        (is_idf(*line.model) || is_epjson(*line.model));
  if (!readable) return run_hosted(library, arguments, {});
  choices.folder = std::filesystem::absolute(*line.model).parent_path();
  choices.file = find_side_file(*line.model, choices);
  auto const method = choices.method.value_or(Method::automatic);
  if (method == Method::scheduled) return run_scheduled(library, choices, arguments);
  return run_by_opengl(library, own_folder() / official_program, line, arguments,
                       read_hosted(*line.model, choices));
}

}  // namespace
}  // namespace gpu_shading::energyplus

// `arguments` are in UTF-8, without the program's name. Returns EnergyPlus's exit status, or -1
// where no rendering is wanted: then EnergyPlus's own program is to be run.
extern "C" __declspec(dllexport) int gpu_shading_energyplus(int count,
                                                            char const* const* arguments) {
  using namespace gpu_shading::energyplus;
  auto const start = std::chrono::steady_clock::now();
  std::filesystem::path folder;
  std::vector<std::string> words;
  try {
    folder = own_folder();
    words.assign(arguments, arguments + count);
    return run(words);
  } catch (std::exception const& error) {
    auto const why = error_line(error);
    std::fprintf(stderr, "gpu_shading: error: %s\n", why.c_str());
    report_refusal(words, folder, why, std::chrono::steady_clock::now() - start);
    return EXIT_FAILURE;
  }
}
