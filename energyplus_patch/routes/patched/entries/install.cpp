#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/renderer.h"
#include "gpu_shading_energyplus.h"
#include "model/idf/model_file.h"
#include "model/options/command_line.h"
#include "model/options/options.h"
#include "platform/c_interface.h"
#include "platform/error_line.h"
#include "platform/process.h"
#include "platform/shared_library.h"
#include "reports/remarks.h"
#include "routes/hosted_run.h"
#include "routes/opengl/opengl_run.h"
#include "routes/patched/binary/entry_patch.h"
#include "routes/patched/binary/symbol_table.h"
#include "routes/patched/entries/daylight_entries.h"
#include "routes/patched/entries/daylight_memory_entries.h"
#include "routes/patched/entries/daylight_reflection_entries.h"
#include "routes/patched/entries/glfw_entries.h"
#include "routes/patched/entries/input_entries.h"
#include "routes/patched/entries/penumbra_entries.h"
#include "routes/patched/entries/reflection_entries.h"
#include "routes/patched/entries/run.h"
#include "routes/patched/entries/shading_entries.h"
#include "routes/patched/entries/unwanted_messages.h"
#include "routes/patched/symbols/loaded_library.h"
#include "routes/schedules/scheduled_run.h"
#include "runs/installation.h"
#include "runs/refused_run.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {
namespace {

// What a host hands over, over the environment. Throws Error.
Choices given_choices(int count, char const* const* options) {
  std::vector<std::string> arguments(options, options + count);
  auto choices = take_flags(arguments);
  if (!arguments.empty()) throw Error(fmt::format("{}: no such flag", arguments.front()));
  choices.fill_from(read_environment());
  apply_to_process(choices);
  return choices;
}

// The reason why a library's shading cannot be redirected; another method may work.
class CannotPatch : public Error {
  using Error::Error;
};

std::optional<StoredResult> find_surface_ids(SymbolTable const& symbols) {
  Symbol const* const caller = symbols.find(
      "_ZN10EnergyPlus12SolarShading30DetermineShadowingCombinationsERNS_14EnergyPlusDataE");
  Symbol const* const callee = symbols.find("_ZN8Penumbra8Penumbra11add_surfaceERKNS_7SurfaceE");
  if (caller == nullptr || callee == nullptr) return std::nullopt;
  return find_stored_result(*caller, *callee);
}

bool can_patch(SymbolTable const& symbols, std::vector<EntryPatch> const& entries) {
  try {
    check_entries(symbols, entries);
    return true;
  } catch (Error const&) {
    return false;
  }
}

std::optional<Installation::DaylightParts> find_daylight_reflections(SymbolTable const& symbols) {
  auto const classes = find_daylight_classes(symbols);
  auto* const element = find_element_function(symbols);
  if (!classes || element == nullptr || !can_patch(symbols, daylight_reflection_entries())) {
    return std::nullopt;
  }
  return Installation::DaylightParts{*classes, element};
}

void patch(Loaded const& loaded, Installation& installed) {
  SymbolTable const symbols(loaded.path, loaded.base);
  auto entries = penumbra_entries();
  for (auto const& more : {input_entries(), shading_entries(), message_entries()}) {
    entries.insert(entries.end(), more.begin(), more.end());
  }
  check_entries(symbols, entries);
  if (auto const days = day_entries(); can_patch(symbols, days)) {
    entries.insert(entries.end(), days.begin(), days.end());
  }
  auto const daylight = daylight_entries();
  auto const daylight_rays = can_patch(symbols, daylight);
  if (daylight_rays) entries.insert(entries.end(), daylight.begin(), daylight.end());
  // Must come before the entries are changed, because it reads the code that calls them.
  auto const surface_ids = find_surface_ids(symbols);
  auto reflection_classes = find_reflection_classes(symbols);
  auto const reflections = reflection_entries();
  if (!surface_ids || !can_patch(symbols, reflections)) reflection_classes.reset();
  if (reflection_classes) entries.insert(entries.end(), reflections.begin(), reflections.end());
  auto const daylight_reflections =
      reflection_classes && daylight_rays ? find_daylight_reflections(symbols) : std::nullopt;
  if (daylight_reflections) {
    auto const more = daylight_reflection_entries();
    entries.insert(entries.end(), more.begin(), more.end());
  }
  auto const memory = daylight_memory_entries();
  bool const daylight_memory = daylight_reflections && can_patch(symbols, memory);
  if (daylight_memory) entries.insert(entries.end(), memory.begin(), memory.end());
  EnergyPlusFunctions const functions(symbols);
  ScheduleFunctions const schedules(symbols);
  auto const version = read_version(loaded.path.parent_path());
  patch_entries(symbols, entries);
  installed.surface_ids = surface_ids;
  installed.reflection_classes = reflection_classes;
  installed.daylight_reflections = daylight_reflections;
  installed.daylight_memory = daylight_memory;
  installed.library = loaded.path;
  installed.version = version;
  installed.daylight_rays = daylight_rays;
  installed.functions = functions;
  installed.schedules = schedules;
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
    SymbolTable const symbols(loaded.path, loaded.base, Symbols::exported);
    if (symbols.find("glfwInit") == nullptr) {
      throw Error(fmt::format("{}: was compiled without OpenGL", loaded.path.string()));
    }
    patch_entries(symbols, glfw_entries());
  } catch (Error const& error) {
    throw CannotPatch(error.what());
  }
}

// Throws CannotPatch where the library or the model does not allow this method.
int run_opengl(char const* library, Choices const& choices,
               std::vector<std::string> const& arguments) {
  SharedLibrary const loaded(library);  // stays loaded
  auto const line = read_command_line(arguments);
  if (line.preprocessed) {
    throw CannotPatch(
        "-m: an EPMacro model cannot be answered through OpenGL; create its IDF first");
  }
  bool const readable = line.model && std::filesystem::exists(*line.model) &&
                        (is_idf(*line.model) || is_epjson(*line.model));
  if (!readable) return run_hosted(library, arguments, {});
  redirect_opengl(library);
  auto read = read_hosted(*line.model, choices);
  return run_by_opengl(library, own_folder() / "energyplus", line, arguments, std::move(read));
}

thread_local std::string message;

int install_with(char const* library, int count, char const* const* options, By by) {
  try {
    auto choices = given_choices(count, options);
    try_device(choices);
    install(library, std::move(choices), by);
    message.clear();
    return 0;
  } catch (CannotPatch const& error) {
    message = error_line(error);
    return 2;
  } catch (std::exception const& error) {
    message = gpu_shading::energyplus::error_line(error);
    return 1;
  }
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
  using gpu_shading::energyplus::message;
  try {
    message.clear();
    auto const choices = gpu_shading::energyplus::given_choices(count, options);
    gpu_shading::energyplus::try_device(choices);
    return gpu_shading::energyplus::run_scheduled(energyplus_library, choices, {argv, argv + argc});
  } catch (std::exception const& error) {
    message = gpu_shading::energyplus::error_line(error);
    return gpu_shading::energyplus::not_run;
  }
}

extern "C" EXPORTED int gpu_shading_run_opengl(char const* energyplus_library, int count,
                                               char const* const* options, int argc,
                                               char const* const* argv) {
  using gpu_shading::energyplus::message;
  constexpr int cannot_patch = -2;
  try {
    message.clear();
    auto const choices = gpu_shading::energyplus::given_choices(count, options);
    gpu_shading::energyplus::try_device(choices);
    return gpu_shading::energyplus::run_opengl(energyplus_library, choices, {argv, argv + argc});
  } catch (gpu_shading::energyplus::CannotPatch const& error) {
    message = gpu_shading::energyplus::error_line(error);
    return cannot_patch;
  } catch (std::exception const& error) {
    message = gpu_shading::energyplus::error_line(error);
    return gpu_shading::energyplus::not_run;
  }
}

extern "C" EXPORTED void gpu_shading_report_refusal(char const* energyplus_library, char const* why,
                                                    int argc, char const* const* argv) {
  using namespace gpu_shading::energyplus;
  std::array<char, 1> ignored{};
  guarded(ignored.data(), ignored.size(), [&] {
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
