#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/error_line.h"
#include "platform/process.h"
#include "routes/hosted_run.h"
#include "routes/opengl/opengl_run.h"
#include "routes/schedules/scheduled_run.h"
#include "runs/refused_run.h"

// Runs EnergyPlus in this process for our energyplus.exe, which has loaded this library.

namespace gpu_shading::energyplus {
namespace {

constexpr char const* energyplus_library = "energyplusapi.dll";
constexpr char const* official_program = "energyplus-official.exe";
constexpr int not_wanted = -1;

int run(RunSetup& setup) {
  if (!setup.wanted) {
    if (setup.line.help) std::fputs(help_hint, stdout);
    return not_wanted;
  }
  auto const library = own_folder() / energyplus_library;
  auto const& line = setup.line;
  if (line.help) std::fputs(options_help().c_str(), stdout);
  if (line.preprocessed) {
    throw Error("-m: an EPMacro model cannot be rendered on Windows; create its IDF first");
  }
  refuse_surroundings(setup.choices);
  if (!setup.has_model()) return run_hosted(library, setup.arguments, {});
  auto& choices = setup.choices;
  choices.folder = std::filesystem::absolute(*line.model).parent_path();
  choices.file = find_side_file(*line.model, choices);
  auto const method = choices.method.value_or(Method::automatic);
  if (method == Method::scheduled) return run_scheduled(library, setup);
  return run_by_opengl(library, own_folder() / official_program, setup);
}

}  // namespace
}  // namespace gpu_shading::energyplus

// `arguments` are in UTF-8, without the program's name. Returns EnergyPlus's exit status, or -1
// where no rendering is wanted: the caller then runs EnergyPlus's own program.
extern "C" __declspec(dllexport) int gpu_shading_energyplus(int count,
                                                            char const* const* arguments) {
  using namespace gpu_shading::energyplus;
  auto const start = std::chrono::steady_clock::now();
  std::filesystem::path folder;
  std::vector<std::string> words;
  try {
    folder = own_folder();
    words.assign(arguments, arguments + count);
    RunSetup setup(words);
    return run(setup);
  } catch (std::exception const& error) {
    auto const why = error_line(error);
    std::fprintf(stderr, "gpu_shading: error: %s\n", why.c_str());
    report_refusal(words, folder, why, std::chrono::steady_clock::now() - start);
    return EXIT_FAILURE;
  }
}
