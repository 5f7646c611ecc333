// energyplus: runs the official program or, with --gpu-shading, EnergyPlus's own library with its
// shading calculation redirected.

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading_energyplus.h"
#include "model/idf/model_text.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/ending_signals.h"
#include "platform/error_line.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/process.h"
#include "platform/text.h"
#include "programs/energyplus/expansion_folder.h"
#include "routes/run_setup.h"
#include "runs/installation.h"
#include "runs/refused_run.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

constexpr char const* official_program = "energyplus-official";
constexpr char const* patch_library = "libgpu_shading_energyplus.so";

void* load(Path const& library) {
  // RTLD_LOCAL: symbols of one library must not resolve to another's (EnergyPlus contains an old
  // expat and sqlite, which Mesa would bind to).
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw Error(dlerror());
  return handle;
}

// Modules that Python plugins import (ctypes) find Python's symbols globally only: the official
// program is linked with EnergyPlus's library.
void* load_energyplus(Path const& library) {
  void* const handle = load(library);
  link_map const* loaded = nullptr;
  if (dlinfo(handle, RTLD_DI_LINKMAP, &loaded) != 0) throw Error(dlerror());
  for (; loaded != nullptr; loaded = loaded->l_next) {
    auto const name = Path(loaded->l_name).filename().string();
    if (name.find("python3.") == std::string::npos) continue;
    dlopen(loaded->l_name, RTLD_NOW | RTLD_NOLOAD | RTLD_GLOBAL);
  }
  return handle;
}

template <typename Function>
Function* find(void* library, char const* name) {
  void* const function = dlsym(library, name);
  if (function == nullptr) throw Error(dlerror());
  return reinterpret_cast<Function*>(function);
}

// The same calls as in EnergyPlus's own program.
using RunEnergyPlus = int(std::vector<std::string> const&, std::string const&);
constexpr char const* run_energyplus =
    "_Z13EnergyPlusPgmRKSt6vectorINSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEESaIS5_EERKS5"
    "_";

// For a folder created from an installation without a program.
[[noreturn]] void run_library(char** argv) {
  std::vector<std::string> arguments;
  for (char** argument = argv; *argument != nullptr; ++argument) arguments.emplace_back(*argument);
  void* const library = load_energyplus(find_energyplus_library(own_folder()));
  std::exit(find<RunEnergyPlus>(library, run_energyplus)(arguments, {}));
}

[[noreturn]] void run_official(char** argv) {
  auto const program = std::filesystem::weakly_canonical(own_folder() / official_program);
  if (!std::filesystem::exists(program)) run_library(argv);
  execv(program.c_str(), argv);
  throw Error(
      fmt::format("{}: {}; {}", program.string(), std::strerror(errno), how_to_restore(program)));
}

// Such a run leaves no files.
class NoOutputFolder : public Error {
  using Error::Error;
};

// EnergyPlus itself would name these on standard output, or end with a library's message.
void check_files(CommandLine const& line) {
  if (!line.runs) return;
  if (line.weather) require_weather(*line.weather);
  std::error_code failure;
  std::filesystem::create_directories(line.output_folder, failure);
  if (!failure) failure = {find_access(line.output_folder), std::generic_category()};
  if (failure) {
    throw NoOutputFolder(fmt::format("-d {}: cannot be written to ({})",
                                     line.output_folder.string(), failure.message()));
  }
}

// The type of the first extension object of an IDF or epJSON file, or "".
std::string find_extension(Path const& model) {
  std::ifstream file(model);
  for (std::string line; std::getline(file, line);) {
    auto const begin =
        std::search(line.begin(), line.end(), extension_prefix.begin(), extension_prefix.end(),
                    [](unsigned char a, char b) { return std::tolower(a) == std::tolower(b); });
    auto const before = trimmed({line.begin(), begin});
    bool const opens = before.empty() || before.ends_with(';') || before.ends_with('"');
    if (begin == line.end() || !opens) continue;
    return {begin, std::find_if(begin, line.end(), [](unsigned char each) {
              return each != ':' && std::isalnum(each) == 0;
            })};
  }
  return {};
}

// Otherwise only EnergyPlus's .err file says why it stops.
void warn_of_extensions(RunSetup const& setup) {
  if (!setup.has_model()) return;
  auto const type = find_extension(*setup.line.model);
  if (type.empty()) return;
  print_line(fmt::format("warning: {}: {} needs --gpu-shading: EnergyPlus alone stops at it",
                         setup.line.model->string(), type));
}

// EnergyPlus itself would say so after its sizing, or in its .err file only.
void check_weather(RunSetup const& setup) {
  auto const& line = setup.line;
  if (line.weather || line.design_days || std::filesystem::exists("in.epw")) return;
  auto const objects = read_objects(*line.model);
  auto const control = std::ranges::find(objects, "SimulationControl", &InputObject::type);
  bool const periods =
      std::ranges::find(objects, "RunPeriod", &InputObject::type) != objects.end() &&
      control != objects.end() &&
      !same_name((*control)["run_simulation_for_weather_file_run_periods"], "No");
  if (!line.annual && !periods) return;
  throw Error(fmt::format(
      "-w: a weather file (.epw) is required for the run periods of {}; -D runs design days alone",
      line.model->filename().string()));
}

void check_preprocessing(RunSetup const& setup) {
  auto const& line = setup.line;
  if (line.expand || !is_idf(*line.model)) return;
  auto const type = find_template(parse_idf(read_text_file(*line.model)));
  if (type.empty()) return;
  throw Error(fmt::format("{}: {} needs ExpandObjects: give -x to energyplus",
                          line.model->filename().string(), type));
}

// Errors in the model are reported before anything is written. What it chooses is added to the
// user's choices, so that the module can check the device before EnergyPlus starts.
void check_model(RunSetup& setup) {
  if (!setup.has_model()) return;
  auto& choices = setup.choices;
  check_preprocessing(setup);
  Reader reader;
  reader.horizons = false;
  reader.release = read_release(own_folder());
  auto const model = read_model(*setup.line.model, choices, reader);
  if (model.options.mode == Mode::off) return;
  prepare_folders(model.options, !choices.task);
  choices.device = model.options.device;
  choices.resolution = model.options.resolution;
}

// EnergyPlus writes the objects that it reads, and ours are removed before.
void check_conversion(RunSetup const& setup) {
  if (!setup.line.convert || !setup.has_model()) return;
  auto const& path = *setup.line.model;
  for (InputObject const& object : read_objects(path)) {
    if (!is_extension(object.type)) continue;
    throw Error(
        fmt::format("{}: {} would be lost in the conversion: expected it in {}.gpu-shading.idf",
                    path.string(), object.type, path.stem().string()));
  }
}

// Runs a command of gpu_shading on the model, into a folder of the report.
void run_for_page(RunSetup const& setup, std::string const& name) {
  auto const& choices = setup.choices;
  std::vector<std::string> command{(own_folder() / "gpu_shading").string(),
                                   name,
                                   setup.line.model->string(),
                                   "-w",
                                   setup.line.weather->string(),
                                   "-o",
                                   (*choices.report / (name == "map" ? "maps" : name)).string()};
  Choices own;
  own.file = choices.file;
  own.threads = choices.threads;
  own.quiet = choices.quiet;
  own.assets = choices.assets;
  for (auto const& flag : to_flags(own)) command.push_back(flag);
  TemporaryFolder const folder;
  auto const log = folder.path() / "log.txt";
  if (run_process(command, {}, log) != EXIT_SUCCESS) {
    throw Error(last_error(log).value_or(fmt::format("gpu_shading {} failed", name)));
  }
}

// Into the report's folder, for its page.
void draw_maps(RunSetup const& setup) {
  auto const& choices = setup.choices;
  if (!choices.maps.value_or(false)) return;
  naming("--gpu-shading-maps", [&] {
    if (!choices.report) throw Error("expected --gpu-shading-report with it");
    if (!setup.line.weather) throw Error("expected a weather file, -w, with it");
    run_for_page(setup, "map");
    if (!read_model(*setup.line.model, choices).pv_modules.empty()) run_for_page(setup, "modules");
  });
}

// Computes the objects of --gpu-shading-surroundings, which the run adds to EnergyPlus's input, and
// what there is to say about them, into a folder.
void trace_surroundings(RunSetup& setup, Path const& folder) {
  auto& choices = setup.choices;
  naming("--gpu-shading-surroundings", [&] {
    auto const& model = *setup.line.model;
    auto const file = folder / (is_epjson(model) ? "objects.epJSON" : "objects.idf");
    std::vector<std::string> command{(own_folder() / "gpu_shading").string(), "export",
                                     model.string(), "--surroundings", file.string()};
    Choices own;
    own.mode = Mode::automatic;
    own.resolution = choices.resolution;
    own.error = choices.error;
    own.device = choices.device;
    own.file = choices.file;
    own.cache = choices.cache;
    own.cache_size = choices.cache_size;
    own.cache_read_only = choices.cache_read_only;
    own.positions = choices.positions;
    own.threads = choices.threads;
    own.assets = choices.assets;
    for (auto const& flag : to_flags(own)) command.push_back(flag);
    auto const log = folder / "log.txt";
    if (run_process(command, {}, log) != EXIT_SUCCESS) {
      throw Error(last_error(log).value_or("gpu_shading export failed"));
    }
    std::ifstream lines(log);
    write_whole_file(folder / surroundings_messages, [&](std::ostream& messages) {
      constexpr std::string_view mark = "gpu_shading: ";
      for (std::string line; std::getline(lines, line);) {
        auto const text = line.starts_with(mark) ? line.substr(mark.size()) : line;
        if (text.starts_with("view factors") || text.starts_with("warning: "))
          messages << text << '\n';
      }
    });
    choices.surrounding_objects = file;
  });
}

// `argv`-style view of strings.
class Words {
 public:
  explicit Words(std::vector<std::string> const& words) {
    for (auto const& word : words) pointers_.push_back(word.c_str());
  }

  int count() const { return static_cast<int>(pointers_.size()); }
  char const* const* data() const { return pointers_.data(); }

 private:
  std::vector<char const*> pointers_;
};

// Our module's functions, include/gpu_shading_energyplus.h.
struct Module {
  using Run = int(char const* library, int, char const* const* flags, int, char const* const*);

  Module() {
    void* const library = load(own_folder() / patch_library);
    install = find<int(char const*, int, char const* const*)>(library, "gpu_shading_install");
    run_opengl = find<Run>(library, "gpu_shading_run_opengl");
    run_scheduled = find<Run>(library, "gpu_shading_run_scheduled");
    message = find<char const*()>(library, "gpu_shading_message");
    unwritten = find<char const*()>(library, "gpu_shading_unwritten");
  }

  int (*install)(char const*, int, char const* const*);
  Run* run_opengl;
  Run* run_scheduled;
  char const* (*message)();
  char const* (*unwritten)();
};

int run_scheduled(Path const& energyplus, Module const& module,
                  std::vector<std::string> const& arguments, Words const& flags) {
  Words const words(arguments);
  int const status = module.run_scheduled(energyplus.c_str(), flags.count(), flags.data(),
                                          words.count(), words.data());
  if (status < 0) throw Error(module.message());
  return status;
}

// Empty where the library or the model does not allow this; the module's message says why.
std::optional<int> run_opengl(Path const& energyplus, Module const& module,
                              std::vector<std::string> const& arguments, Words const& flags) {
  Words const words(arguments);
  int const status = module.run_opengl(energyplus.c_str(), flags.count(), flags.data(),
                                       words.count(), words.data());
  if (status == gpu_shading_cannot_patch) return std::nullopt;
  if (status < 0) throw Error(module.message());
  return status;
}

// For a library whose shading functions cannot be redirected.
int run_unpatched(Path const& energyplus, Module const& module,
                  std::vector<std::string> const& arguments, Words const& flags, bool task) {
  print_line(fmt::format("this EnergyPlus cannot be patched: {}", module.message()));
  if (auto const status = run_opengl(energyplus, module, arguments, flags)) return *status;
  if (task) throw Error(module.message());
  print_line(fmt::format("sunlit fractions are passed as schedules: {}", module.message()));
  return run_scheduled(energyplus, module, arguments, flags);
}

// `energyplus example NAME` is `gpu_shading example NAME`. EnergyPlus takes no file without an
// ending.
void run_example(char** argv) {
  auto const program = own_folder() / "gpu_shading";
  execv(program.c_str(), argv);
  throw Error(fmt::format("{}: {}", program.string(), std::strerror(errno)));
}

// The program's name and EnergyPlus's arguments.
int run_shaded(char const* program, std::vector<std::string> arguments, Choices const& choices) {
  auto const energyplus = find_energyplus_library(own_folder());
  auto const texts = to_flags(choices);
  Words const flags(texts);
  auto const method = choices.method.value_or(Method::automatic);
  void* const library = load_energyplus(energyplus);
  Module const module;
  if (method == Method::scheduled) return run_scheduled(energyplus, module, arguments, flags);
  if (method == Method::opengl) {
    if (auto const status = run_opengl(energyplus, module, arguments, flags)) return *status;
    throw Error(module.message());
  }

  int const installed = module.install(energyplus.c_str(), flags.count(), flags.data());
  if (installed == gpu_shading_cannot_patch && method == Method::automatic) {
    return run_unpatched(energyplus, module, arguments, flags, choices.task.has_value());
  }
  if (installed != gpu_shading_done) throw Error(module.message());
  arguments.insert(arguments.begin(), program);
  int const status = find<RunEnergyPlus>(library, run_energyplus)(arguments, {});
  // The reason has been printed.
  return status == EXIT_SUCCESS && *module.unwritten() != '\0' ? EXIT_FAILURE : status;
}

int launch(RunSetup& setup, char** argv) {
  auto const& line = setup.line;
  if (!setup.arguments.empty() && setup.arguments.front() == "example") run_example(argv);
  if (!setup.wanted) {
    if (line.help) fmt::print("{}", help_hint);
    warn_of_extensions(setup);
    std::fflush(stdout);
    run_official(argv);
  }
  auto& choices = setup.choices;
  if (line.version) fmt::print("gpu_shading {}\n", GPU_SHADING_VERSION);
  if (line.help) fmt::print("{}", options_help());
  check_files(line);
  std::optional<TemporaryFolder> surroundings;
  if (line.model) {
    if (line.runs) require_model(*line.model);
    check_conversion(setup);
    check_model(setup);
    if (line.runs && !line.convert) check_weather(setup);
    draw_maps(setup);
    if (choices.surroundings.value_or(false) && !choices.task) {
      trace_surroundings(setup, surroundings.emplace().path());
    }
    // A preprocessor (-x) passes another file to EnergyPlus, but files in the folder of the user's
    // model still apply.
    choices.folder = std::filesystem::absolute(*line.model).parent_path();
    choices.file = find_side_file(*line.model, choices);
  }
  std::optional<ExpansionFolder> expansion;
  auto energyplus_arguments = setup.arguments;
  if (line.expand && line.model) {
    expansion.emplace(energyplus_arguments, line);
    choices.start = expansion->start();
    if (choices.file) choices.file = *choices.start / *choices.file;
  }
  int const status = run_shaded(argv[0], std::move(energyplus_arguments), choices);
  expansion.reset();  // back to the user's folder
  // The program that set a task tells what it finds in the folder, which it deletes.
  if (status != EXIT_SUCCESS && !choices.task) print_first_error(setup.arguments);
  return status;
}

}  // namespace
}  // namespace gpu_shading::energyplus

int main(int argc, char** argv) {
  using namespace gpu_shading::energyplus;
  auto const start = std::chrono::steady_clock::now();
  catch_lack_of_memory();
  clean_up_at_signals();
  occupy_standard_descriptors();
  std::filesystem::path folder;
  std::optional<std::vector<std::string>> arguments;
  try {
    folder = own_folder();
    arguments = arguments_of(argc, argv);
    RunSetup setup(*arguments);
    return launch(setup, argv);
  } catch (std::exception const& error) {
    auto const why = error_line(error);
    std::fprintf(stderr, "gpu_shading: error: %s\n", why.c_str());
    // Without its arguments, it is not known where a run's files belong.
    if (arguments && dynamic_cast<NoOutputFolder const*>(&error) == nullptr) {
      report_refusal(*arguments, folder, why, std::chrono::steady_clock::now() - start);
    }
    return EXIT_FAILURE;
  }
}
