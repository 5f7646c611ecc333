// The libenergyplusapi.so of a folder that patch_energyplus makes. It needs the official library,
// so that every symbol resolves as there, and stands before it in the two functions that run a
// simulation: with GPU_SHADING set, these install our module first. So hosts of EnergyPlus's C and
// Python API, and programs linked with it, are shaded without a call of their own.

#include <dlfcn.h>
#include <link.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading_energyplus.h"
#include "platform/c_interface.h"

namespace {

using Path = std::filesystem::path;

constexpr char const* official_library = "libenergyplusapi-official.so";
constexpr char const* patch_library = "libgpu_shading_energyplus.so";

// Where this library is loaded from, links followed: the folder that patch_energyplus made. Empty
// if it is not known.
Path find_own_folder() noexcept try {
  Dl_info info{};
  link_map* map = nullptr;
  dladdr1(reinterpret_cast<void const*>(&find_own_folder), &info, reinterpret_cast<void**>(&map),
          RTLD_DL_LINKMAP);
  if (map == nullptr || map->l_name == nullptr) return {};
  return std::filesystem::canonical(map->l_name).parent_path();
} catch (...) {
  return {};
}

// As this library is loaded: a host may name it relative to the folder that is current then.
Path const own_folder = find_own_folder();

template <typename Function>
Function* find(void* library, char const* name) {
  void* const function = dlsym(library, name);
  if (function == nullptr) fail(dlerror());
  return reinterpret_cast<Function*>(function);
}

// include/gpu_shading_energyplus.h
struct Module {
  explicit Module(Path const& path) {
    // RTLD_LOCAL: symbols of one library must not resolve to another's.
    void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) fail(dlerror());
    install = find<int(char const*)>(library, "gpu_shading_install_from_environment");
    message = find<char const*()>(library, "gpu_shading_message");
    unwritten = find<char const*()>(library, "gpu_shading_unwritten");
    report_refusal = find<void(char const*, char const*, int, char const* const*)>(
        library, "gpu_shading_report_refusal");
  }

  int (*install)(char const*);
  char const* (*message)();
  char const* (*unwritten)();
  void (*report_refusal)(char const*, char const*, int, char const* const*);
};

bool asked() {
  char const* const value = std::getenv("GPU_SHADING");
  return value != nullptr && *value != '\0';
}

// Runs of this process, which may be of several threads.
class Runs {
 public:
  // The module, or nullptr for a run of the official library. Throws where that cannot be.
  Module const* begin() {
    std::scoped_lock const lock(mutex_);
    if (!asked()) {
      if (!module_) return nullptr;
      fail(
          "GPU_SHADING was set for an earlier run of this process, whose EnergyPlus stays patched; "
          "to compare with polygon clipping, set it to off");
    }
    if (!module_ || running_ == 0) install();
    ++running_;
    return &*module_;
  }

  void end() {
    std::scoped_lock const lock(mutex_);
    --running_;
  }

 private:
  // With the options of the environment as it is now.
  void install() {
    if (own_folder.empty()) fail("the folder of libenergyplusapi is not known");
    Module const module(own_folder / patch_library);
    int const status = module.install((own_folder / official_library).c_str());
    if (status == gpu_shading_cannot_patch) {
      fail(std::string(module.message()) + "; run " + (own_folder / "energyplus").string() +
           ", which passes sunlit fractions as schedules");
    }
    if (status != gpu_shading_done) fail(module.message());
    module_ = module;
  }

  std::mutex mutex_;
  std::optional<Module> module_;
  int running_ = 0;
};

Runs& runs() {
  static Runs instance;
  return instance;
}

// Says why a run is refused: on standard error, and in EnergyPlus's files if our module can be
// loaded. `words`: EnergyPlus's arguments, after the program's name.
void refuse(char const* why, std::vector<char const*> const& words) {
  std::fprintf(stderr, "gpu_shading: error: %s\n", why);
  if (words.empty()) return;
  failure_of([&] {
    Module const module(own_folder / patch_library);
    module.report_refusal((own_folder / official_library).c_str(), why,
                          static_cast<int>(words.size()) - 1, words.data() + 1);
  });
}

// Calls the official library's function of that name, which returns an exit status. `words()`:
// the program's name and EnergyPlus's arguments.
template <typename Function, typename Words, typename... Arguments>
int run(char const* name, Words const& words, Arguments&&... arguments) {
  Function* original = nullptr;
  Module const* module = nullptr;
  auto const refused = failure_of([&] {
    original = find<Function>(RTLD_NEXT, name);
    module = runs().begin();
  });
  if (!refused.empty()) {
    refuse(refused.c_str(), words());
    return EXIT_FAILURE;
  }
  if (module == nullptr) return original(std::forward<Arguments>(arguments)...);
  auto const leave = [](Runs* all) { all->end(); };
  std::unique_ptr<Runs, decltype(leave)> const running(&runs(), leave);
  int const status = original(std::forward<Arguments>(arguments)...);
  // The user has been told why.
  return status == EXIT_SUCCESS && *module->unwritten() != '\0' ? EXIT_FAILURE : status;
}

}  // namespace

// EnergyPlus/api/runtime.h
extern "C" EXPORTED int energyplus(void* state, int argc, char const** argv) {
  auto const words = [&] { return std::vector<char const*>(argv, argv + argc); };
  return run<int(void*, int, char const**)>("energyplus", words, state, argc, argv);
}

// EnergyPlus/api/EnergyPlusPgm.hh, which EnergyPlus's own program calls.
EXPORTED int EnergyPlusPgm(std::vector<std::string> const& arguments, std::string const& path) {
  auto const words = [&] {
    std::vector<char const*> result;
    result.reserve(arguments.size());
    for (auto const& argument : arguments) result.push_back(argument.c_str());
    return result;
  };
  return run<int(std::vector<std::string> const&, std::string const&)>(
      "_Z13EnergyPlusPgmRKSt6vectorINSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEESaIS5_"
      "EERKS5_",
      words, arguments, path);
}
