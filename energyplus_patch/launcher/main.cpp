// energyplus: the official program where --gpu-shading is not asked for, else EnergyPlus's own
// library with its shading calculation taken over.

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "host/own_folder.h"
#include "host/version.h"
#include "input/model_reader.h"
#include "launcher/command_line.h"
#include "session/cache_folder.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

constexpr char const* official_program = "energyplus-official";
constexpr char const* patch_library = "libgpu_shading_energyplus.so";

[[noreturn]] void run_official(char** argv) {
  auto const program = std::filesystem::weakly_canonical(own_folder() / official_program);
  execv(program.c_str(), argv);
  throw Error(fmt::format("{}: {}; make this prefix again with patch_energyplus", program.string(),
                          std::strerror(errno)));
}

Path find_energyplus_library(Path const& folder) {
  Path found;
  for (auto const& entry : std::filesystem::directory_iterator(folder)) {
    auto const name = entry.path().filename().string();
    // The versioned name is the one that the official program loads.
    if (name.starts_with("libenergyplusapi.so") && name > found.filename().string()) {
      found = entry.path();
    }
  }
  if (found.empty()) {
    throw Error(
        fmt::format("{}: has no libenergyplusapi.so; make this prefix again with "
                    "patch_energyplus",
                    folder.string()));
  }
  return std::filesystem::canonical(found);
}

void* load(Path const& library) {
  // Local: what one library exports must not be taken for another's (EnergyPlus's carries an old
  // expat and sqlite, which Mesa would bind to).
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw Error(dlerror());
  return handle;
}

template <typename Function>
Function* find(void* library, char const* name) {
  void* const function = dlsym(library, name);
  if (function == nullptr) throw Error(dlerror());
  return reinterpret_cast<Function*>(function);
}

// Errors of the model come before anything is written.
void check_model(Path const& path, Choices const& choices) {
  if (!std::filesystem::exists(path) || (!is_idf(path) && !is_epjson(path))) return;
  auto const model = read_model(path, choices);
  if (model.options.mode != Mode::off) {
    check_supported(model.shading, read_version(own_folder()));
    if (model.options.cache) prepare_cache_folder(*model.options.cache);
  }
}

int run_patched(std::vector<std::string> const& arguments, std::string const& flags) {
  auto const folder = own_folder();
  auto const energyplus = find_energyplus_library(folder);
  void* const library = load(energyplus);
  void* const patch = load(folder / patch_library);
  auto* const install = find<int(char const*, char const*)>(patch, "gpu_shading_install");
  auto* const message = find<char const*()>(patch, "gpu_shading_message");
  if (install(energyplus.c_str(), flags.c_str()) != 0) throw Error(message());

  auto* const run = find<int(std::vector<std::string> const&, std::string const&)>(
      library,
      "_Z13EnergyPlusPgmRKSt6vectorINSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEESaIS5_"
      "EERKS5_");
  return run(arguments, {});
}

int launch(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  auto choices = take_flags(arguments);
  auto const environment = read_environment();
  if (!choices.any() && !environment.mode) run_official(argv);
  choices.fill_from(environment);

  auto const line = read_command_line(arguments);
  if (line.help) std::fputs(std::string(flags_help()).c_str(), stdout);
  if (line.model) {
    check_model(*line.model, choices);
    // A preprocessor (-x) hands EnergyPlus another file; what lies beside the user's still counts.
    choices.folder = std::filesystem::absolute(*line.model).parent_path();
    choices.file = find_side_file(*line.model, choices);
  }
  arguments.insert(arguments.begin(), argv[0]);
  return run_patched(arguments, to_flags(choices));
}

}  // namespace
}  // namespace gpu_shading::energyplus

int main(int argc, char** argv) {
  try {
    return gpu_shading::energyplus::launch(argc, argv);
  } catch (std::exception const& error) {
    std::fprintf(stderr, "gpu_shading: error: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
