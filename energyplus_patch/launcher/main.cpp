// energyplus: the official program where --gpu-shading is not asked for, else EnergyPlus's own
// library with its shading calculation taken over.

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
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

// What EnergyPlus's own program does.
using RunEnergyPlus = int(std::vector<std::string> const&, std::string const&);
constexpr char const* run_energyplus =
    "_Z13EnergyPlusPgmRKSt6vectorINSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEESaIS5_EERKS5"
    "_";

// In a folder made of an installation without a program.
[[noreturn]] void run_library(char** argv) {
  std::vector<std::string> arguments;
  for (char** argument = argv; *argument != nullptr; ++argument) arguments.emplace_back(*argument);
  void* const library = load(find_energyplus_library(own_folder()));
  std::exit(find<RunEnergyPlus>(library, run_energyplus)(arguments, {}));
}

[[noreturn]] void run_official(char** argv) {
  auto const program = std::filesystem::weakly_canonical(own_folder() / official_program);
  if (!std::filesystem::exists(program)) run_library(argv);
  execv(program.c_str(), argv);
  throw Error(fmt::format("{}: {}; make this prefix again with patch_energyplus", program.string(),
                          std::strerror(errno)));
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

// Our module's functions, include/gpu_shading_energyplus.h.
struct Module {
  Module() {
    void* const library = load(own_folder() / patch_library);
    install = find<int(char const*, char const*)>(library, "gpu_shading_install");
    run_scheduled = find<int(char const*, char const*, int, char const* const*)>(
        library, "gpu_shading_run_scheduled");
    message = find<char const*()>(library, "gpu_shading_message");
  }

  int (*install)(char const*, char const*);
  int (*run_scheduled)(char const*, char const*, int, char const* const*);
  char const* (*message)();
};

int run_scheduled(Path const& energyplus, Module const& module,
                  std::vector<std::string> const& arguments, std::string const& flags) {
  std::vector<char const*> words;
  words.reserve(arguments.size());
  for (auto const& argument : arguments) words.push_back(argument.c_str());
  int const status = module.run_scheduled(energyplus.c_str(), flags.c_str(),
                                          static_cast<int>(words.size()), words.data());
  if (status < 0) throw Error(module.message());
  return status;
}

// A reason and what it lists on lines of their own, of which the first will do.
std::string in_one_line(std::string const& message) {
  std::istringstream text(message);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  if (lines.size() < 2) return message;
  auto const first = lines[1].substr(std::min(lines[1].find_first_not_of(' '), lines[1].size()));
  return fmt::format("{} {}{}", lines[0], first,
                     lines.size() == 2 ? "" : fmt::format(" and {} more", lines.size() - 2));
}

// The program's name and EnergyPlus's arguments.
int run_shaded(char const* program, std::vector<std::string> arguments, Choices const& choices) {
  auto const energyplus = find_energyplus_library(own_folder());
  auto const flags = to_flags(choices);
  auto const method = choices.method.value_or(Method::automatic);
  Module const module;
  if (method == Method::scheduled) return run_scheduled(energyplus, module, arguments, flags);

  void* const library = load(energyplus);
  constexpr int cannot_patch = 2;
  int const installed = module.install(energyplus.c_str(), flags.c_str());
  if (installed == cannot_patch && method == Method::automatic) {
    fmt::print(stderr, "gpu_shading: sunlit fractions go in as schedules: {}\n",
               in_one_line(module.message()));
    return run_scheduled(energyplus, module, arguments, flags);
  }
  if (installed != 0) throw Error(module.message());
  arguments.insert(arguments.begin(), program);
  return find<RunEnergyPlus>(library, run_energyplus)(arguments, {});
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
  return run_shaded(argv[0], std::move(arguments), choices);
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
