#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/renderer.h"
#include "gpu_shading_energyplus.h"
#include "platform/c_interface.h"
#include "platform/error_line.h"
#include "platform/process.h"
#include "platform/shared_library.h"
#include "reports/remarks.h"
#include "routes/hosted_run.h"
#include "routes/opengl/opengl_run.h"
#include "routes/patched/binary/entry_patch.h"
#include "routes/patched/binary/symbol_table.h"
#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"
#include "routes/patched/symbols/loaded_library.h"
#include "routes/schedules/scheduled_run.h"
#include "runs/installation.h"
#include "runs/refused_run.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {
namespace {

// The options of a host, and EnergyPlus's arguments. Throws Error.
RunSetup read_setup(int count, char const* const* options, std::vector<std::string> arguments) {
  std::vector<std::string> flags(options, options + count);
  RunSetup given(flags);
  if (!given.arguments.empty())
    throw Error(fmt::format("{}: no such flag", given.arguments.front()));
  refuse_surroundings(given.choices);
  apply_to_process(given.choices);
  given.arguments = std::move(arguments);
  given.line = read_command_line(given.arguments);
  return given;
}

// The reason why a library's shading cannot be redirected; another method may work.
class CannotPatch : public Error {
  using Error::Error;
};

std::vector<Entry> all_entries() {
  std::vector<Entry> entries;
  for (auto const& part :
       {penumbra_entries(), input_entries(), shading_entries(), message_entries(),
        daylight_entries(), daylight_memory_entries(), reflected_light_entries()}) {
    entries.insert(entries.end(), part.begin(), part.end());
  }
  return entries;
}

// Those of some needs.
std::vector<EntryPatch> patches_of(std::vector<Entry> const& entries, std::set<Need> const& needs) {
  std::vector<EntryPatch> patches;
  for (auto const& entry : entries) {
    if (needs.contains(entry.need)) patches.push_back(entry.patch);
  }
  return patches;
}

// The needs for which this build has all symbols and lets all entries be redirected. Throws Error
// if it cannot be patched.
std::set<Need> find_served(SymbolTable const& symbols, std::vector<Entry> const& entries,
                           bool has_surface_ids) {
  std::map<Need, std::string> problems;
  for (auto const& row : energyplus_symbols) {
    auto& lines = problems[row.need];
    if (symbols.find(row.symbol) == nullptr)
      lines += fmt::format("\n  {}: not in this build", row.symbol);
  }
  std::set<Need> served;
  for (auto& [need, lines] : problems) {
    if (lines.empty()) lines = problems_of(symbols, patches_of(entries, {need}));
    if (lines.empty()) served.insert(need);
  }
  if (!served.contains(Need::run)) throw cannot_redirect(symbols, problems[Need::run]);
  if (!served.contains(Need::from_25_1) && !served.contains(Need::before_25_1)) {
    throw cannot_redirect(symbols, problems[Need::from_25_1]);
  }
  if (!has_surface_ids) served.erase(Need::surface_ids);
  // Some build on others.
  auto const require = [&](Need need, Need other) {
    if (!served.contains(other)) served.erase(need);
  };
  require(Need::sky_patches, Need::surface_ids);
  require(Need::sky_patches, Need::long_wave);
  require(Need::sky_patches, Need::run_days);
  require(Need::reflected_light, Need::run_days);
  require(Need::reflected_light, Need::constants);
  require(Need::reflected_light, Need::from_25_1);
  require(Need::daylight_memory, Need::daylight_rays);
  return served;
}

void patch(Loaded const& loaded, Installation& installed) {
  SymbolTable const symbols(loaded.path, loaded.base, energyplus_symbol_names());
  auto const entries = all_entries();
  // Must come before the entries are changed, because it reads the code that calls them.
  auto const surface_ids = find_surface_ids(symbols);
  auto served = find_served(symbols, entries, surface_ids.has_value());
  ScheduleFunctions const schedules(symbols);
  auto release = read_release(loaded.path.parent_path());
  patch_entries(symbols, patches_of(entries, served));
  installed.library = loaded.path;
  installed.release = std::move(release);
  installed.functions = EnergyPlusFunctions(symbols);
  installed.schedules = schedules;
  installed.served = std::move(served);
  installed.surface_ids = surface_ids;
}

enum class By { host, environment };

void install(char const* library, Choices choices, By by) {
  static std::mutex mutex;
  static bool by_host = false;
  std::scoped_lock const lock(mutex);
  if (by == By::environment && by_host) return;
  auto const loaded = find_loaded(library);
  auto& installed = installation();
  if (installed.library.empty()) {
    try {
      patch(loaded, installed);
    } catch (Error const& error) {
      throw CannotPatch(error.what());
    }
  } else if (installed.library != loaded.path) {
    throw Error(fmt::format("{}: GPU shading is already installed for {}", loaded.path.string(),
                            installed.library.string()));
  }
  installed.task.reset();
  if (choices.task) installed.task.emplace(*choices.task);
  installed.choices = std::move(choices);
  by_host = by_host || by == By::host;
}

// Opens and closes the device where it may not be there or not do what is asked, so that a run need
// not begin for it.
void try_device(Choices const& choices) {
  constexpr int every_device_draws = 16384;
  bool const required = choices.mode == Mode::require;
  bool const chosen = choices.device && choices.device->device && !choices.device->device->is_cpu();
  bool const large = choices.resolution.value_or(1) > every_device_draws;
  if (choices.mode == Mode::off || (!required && !chosen && !large)) return;
  Options options;
  options.mode = choices.mode.value_or(Mode::automatic);
  options.device = choices.device.value_or(DeviceChoice{});
  options.resolution = choices.resolution;
  Renderer const renderer(Scene{}, renderer_options(options));
  auto const ignore = [](std::string const&) {};
  check_device(renderer.device(), options, {ignore, ignore, ignore});
}

// Leads the library's calls of OpenGL to us. Throws CannotPatch.
void redirect_opengl(char const* library) {
  auto const loaded = find_loaded(library);
  try {
    auto const entries = glfw_entries();
    SymbolTable const symbols(loaded.path, loaded.base, names_of(entries), Symbols::exported);
    if (symbols.find("glfwInit") == nullptr) {
      throw Error(fmt::format("{}: was compiled without OpenGL", loaded.path.string()));
    }
    patch_entries(symbols, entries);
  } catch (Error const& error) {
    throw CannotPatch(error.what());
  }
}

// Throws CannotPatch where the library or the model does not allow this method.
int run_opengl(char const* library, RunSetup const& setup) {
  SharedLibrary const loaded(library);  // stays loaded
  if (setup.line.preprocessed) {
    throw CannotPatch(
        "-m: an EPMacro model cannot be answered through OpenGL; create its IDF first");
  }
  if (!setup.has_model()) return run_hosted(library, setup.arguments, {});
  redirect_opengl(library);
  return run_by_opengl(library, own_folder() / "energyplus", setup);
}

thread_local std::string message;

// Calls `action`, which returns a status; no exception leaves this function.
template <typename Action>
int with_status(Action const& action) {
  message.clear();
  try {
    return action();
  } catch (CannotPatch const& error) {
    message = error_line(error);
    return gpu_shading_cannot_patch;
  } catch (std::exception const& error) {
    message = error_line(error);
    return gpu_shading_failed;
  }
}

int install_with(char const* library, int count, char const* const* options, By by) {
  return with_status([&] {
    auto setup = read_setup(count, options, {});
    try_device(setup.choices);
    install(library, std::move(setup.choices), by);
    return gpu_shading_done;
  });
}

// `run`: run_scheduled() or run_opengl().
template <typename RunLibrary>
int run_with(char const* library, int count, char const* const* options,
             std::vector<std::string> arguments, RunLibrary const& run) {
  return with_status([&] {
    auto const setup = read_setup(count, options, std::move(arguments));
    try_device(setup.choices);
    return run(library, setup);
  });
}

}  // namespace
}  // namespace gpu_shading::energyplus

extern "C" EXPORTED int gpu_shading_install(char const* energyplus_library, int count,
                                            char const* const* options) {
  using namespace gpu_shading::energyplus;
  return install_with(energyplus_library, count, options, By::host);
}

extern "C" EXPORTED int gpu_shading_install_from_environment(char const* energyplus_library) {
  using namespace gpu_shading::energyplus;
  return install_with(energyplus_library, 0, nullptr, By::environment);
}

extern "C" EXPORTED int gpu_shading_run_scheduled(char const* energyplus_library, int count,
                                                  char const* const* options, int argc,
                                                  char const* const* argv) {
  using namespace gpu_shading::energyplus;
  return run_with(energyplus_library, count, options, {argv, argv + argc}, run_scheduled);
}

extern "C" EXPORTED int gpu_shading_run_opengl(char const* energyplus_library, int count,
                                               char const* const* options, int argc,
                                               char const* const* argv) {
  using namespace gpu_shading::energyplus;
  return run_with(energyplus_library, count, options, {argv, argv + argc}, run_opengl);
}

extern "C" EXPORTED void gpu_shading_report_refusal(char const* energyplus_library, char const* why,
                                                    int argc, char const* const* argv) {
  using namespace gpu_shading::energyplus;
  failure_of([&] {
    report_refusal({argv, argv + argc}, std::filesystem::path(energyplus_library).parent_path(),
                   why, {});
  });
}

extern "C" EXPORTED char const* gpu_shading_unwritten(void) {
  return gpu_shading::energyplus::this_run().unwritten.c_str();
}

extern "C" EXPORTED char const* gpu_shading_message(void) {
  return gpu_shading::energyplus::message.c_str();
}
