#include "model/options/options.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <variant>

#include "gpu_shading/error.h"
#include "gpu_shading/renderer.h"
#include "gpu_shading/threads.h"
#include "model/extensions/extension_fields.h"
#include "model/extensions/field_text.h"
#include "platform/console.h"
#include "platform/process.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace settings = extension::settings;

// Whether one of the words for yes or no.
std::optional<bool> parse_switch(std::string const& text) {
  for (auto const* word : {"on", "yes", "true", "1"}) {
    if (same_name(text, word)) return true;
  }
  for (auto const* word : {"off", "no", "false", "0"}) {
    if (same_name(text, word)) return false;
  }
  return std::nullopt;
}

Mode parse_mode(std::string const& text) {
  if (auto const chosen = parse_switch(text)) return *chosen ? Mode::automatic : Mode::off;
  if (same_name(text, "auto")) return Mode::automatic;
  if (same_name(text, "require")) return Mode::require;
  throw Error(fmt::format("is \"{}\", expected auto, require or off", text));
}

Lean parse_lean(std::string const& text) {
  if (same_name(text, "auto")) return Lean::automatic;
  if (same_name(text, "on")) return Lean::on;
  if (same_name(text, "off")) return Lean::off;
  throw Error(fmt::format("is \"{}\", expected auto, on or off", text));
}

Assets parse_assets(std::string const& text) {
  if (same_name(text, "restricted")) return Assets::restricted;
  if (same_name(text, "any")) return Assets::any;
  throw Error(fmt::format("is \"{}\", expected restricted or any", text));
}

Method parse_method(std::string const& text) {
  if (same_name(text, "auto")) return Method::automatic;
  if (same_name(text, "patched")) return Method::patched;
  if (same_name(text, "opengl")) return Method::opengl;
  if (same_name(text, "scheduled")) return Method::scheduled;
  throw Error(fmt::format("is \"{}\", expected auto, patched, opengl or scheduled", text));
}

int parse_threads(std::string const& text) {
  constexpr double most = 4096;
  auto const number = parse_number(text);
  if (!number || std::floor(*number) != *number || *number < 1 || *number > most) {
    throw Error(fmt::format("is {}, expected a whole number from 1", in_quotes(text)));
  }
  return static_cast<int>(*number);
}

bool parse_quiet(std::string const& text) {
  auto const quiet = parse_switch(text);
  if (!quiet) throw Error(fmt::format("is {}, expected on or off", in_quotes(text)));
  return *quiet;
}

Update update_of(settings::UpdateFrequency frequency) {
  using enum settings::UpdateFrequency;
  using enum Sampling::Density;
  switch (frequency) {
    case timestep:
      return {true};
    case sampled_fine:
      return {true, Sampling{fine, false}};
    case sampled_medium:
      return {true, Sampling{medium, false}};
    case sampled_coarse:
      return {true, Sampling{coarse, false}};
    case sampled_paper_fine:
      return {true, Sampling{fine, true}};
    case sampled_paper_medium:
      return {true, Sampling{medium, true}};
    case sampled_paper_coarse:
      return {true, Sampling{coarse, true}};
    case idf:
      break;
  }
  return {};
}

DeviceChoice device_of(std::variant<int, settings::Device> const& device) {
  using Kind = DeviceChoice::Kind;
  if (auto const* const index = std::get_if<int>(&device)) return {Kind::index, *index};
  switch (std::get<settings::Device>(device)) {
    case settings::Device::cpu:
    case settings::Device::software:
      return {Kind::cpu, 0};
    case settings::Device::automatic:
      break;
  }
  return {Kind::automatic, 0};
}

std::filesystem::path parse_path(std::string const& text, std::string_view expected) {
  if (text.empty()) throw Error(fmt::format("is \"\", expected {}", expected));
  return std::filesystem::absolute(text);
}

std::filesystem::path parse_folder(std::string const& text) { return parse_path(text, "a folder"); }
std::filesystem::path parse_file(std::string const& text) { return parse_path(text, "a file"); }

std::filesystem::path parse_cache(std::string const& text) {
  return same_name(text, "off") ? std::filesystem::path() : parse_path(text, "a folder or off");
}

// One option under all its names.
struct Choice {
  std::string_view flag;
  char const* variable;    // nullptr: none
  FieldInfo const* field;  // of GPUShading:Settings, or nullptr
  // From a text that is not blank where there is a field, and that `field` allows.
  std::function<void(Choices&, std::string const&)> set;
  char const* bare = nullptr;  // what the flag stands for alone; nullptr: a value follows it
};

// What a field of the settings holds, for a text that was checked.
template <typename Value>
auto value_of(Field<Value> const& field, std::string const& text) {
  return parse(field, text, field.title);
}

std::array<Choice, 17> const& all_choices() {
  static std::array<Choice, 17> const choices{{
      {"--gpu-shading", "GPU_SHADING", nullptr,
       [](Choices& c, std::string const& v) { c.mode = parse_mode(v); }, "auto"},
      {"--gpu-shading-resolution", "GPU_SHADING_RESOLUTION", &settings::resolution,
       [](Choices& c, std::string const& v) { c.resolution = value_of(settings::resolution, v); }},
      {"--gpu-shading-error", "GPU_SHADING_ERROR", &settings::error,
       [](Choices& c, std::string const& v) { c.error = value_of(settings::error, v); }},
      {"--gpu-shading-update", "GPU_SHADING_UPDATE", &settings::update_frequency,
       [](Choices& c, std::string const& v) {
         c.update = update_of(value_of(settings::update_frequency, v));
       }},
      {"--gpu-shading-device", "GPU_SHADING_DEVICE", &settings::device,
       [](Choices& c, std::string const& v) {
         c.device = device_of(value_of(settings::device, v));
       }},
      {"--gpu-shading-file", "GPU_SHADING_FILE", nullptr,
       [](Choices& c, std::string const& v) { c.file = parse_file(v); }},
      {"--gpu-shading-report", "GPU_SHADING_REPORT", nullptr,
       [](Choices& c, std::string const& v) { c.report = parse_folder(v); }},
      {"--gpu-shading-cache", "GPU_SHADING_CACHE", nullptr,
       [](Choices& c, std::string const& v) { c.cache = parse_cache(v); }},
      {"--gpu-shading-model-folder", nullptr, nullptr,
       [](Choices& c, std::string const& v) { c.folder = parse_folder(v); }},
      {"--gpu-shading-start-folder", nullptr, nullptr,
       [](Choices& c, std::string const& v) { c.start = parse_folder(v); }},
      {"--gpu-shading-lean", "GPU_SHADING_LEAN", nullptr,
       [](Choices& c, std::string const& v) { c.lean = parse_lean(v); }},
      {"--gpu-shading-method", "GPU_SHADING_METHOD", nullptr,
       [](Choices& c, std::string const& v) { c.method = parse_method(v); }},
      {"--gpu-shading-assets", "GPU_SHADING_ASSETS", nullptr,
       [](Choices& c, std::string const& v) { c.assets = parse_assets(v); }},
      {"--gpu-shading-threads", "GPU_SHADING_THREADS", nullptr,
       [](Choices& c, std::string const& v) { c.threads = parse_threads(v); }},
      {"--gpu-shading-quiet", "GPU_SHADING_QUIET", nullptr,
       [](Choices& c, std::string const& v) { c.quiet = parse_quiet(v); }, "on"},
      {"--gpu-shading-stages", "GPU_SHADING_STAGES", nullptr,
       [](Choices& c, std::string const& v) { c.stages = parse_file(v); }},
      {"--gpu-shading-task", nullptr, nullptr,
       [](Choices& c, std::string const& v) { c.task = parse_file(v); }},
  }};
  return choices;
}

// `source`: what the value goes by for the user.
void set(Choice const& choice, Choices& choices, std::string_view source,
         std::string const& value) {
  if (choice.field != nullptr) {
    if (value.empty()) {
      throw Error(fmt::format("{} is blank, expected {}", source, expectation(*choice.field)));
    }
    check(*choice.field, value, source);
  }
  try {
    choice.set(choices, value);
  } catch (Error const& error) {
    throw Error(fmt::format("{} {}", source, error.what()));
  }
}

void expect_one_fineness(Choices const& choices, std::string_view resolution,
                         std::string_view error) {
  if (choices.resolution && choices.error) {
    throw Error(fmt::format("{} and {} are both given, expected one of them", resolution, error));
  }
}

template <typename T>
void fill(std::optional<T>& value, std::optional<T> const& lower) {
  if (!value) value = lower;
}

}  // namespace

std::string name_of(Mode mode) {
  switch (mode) {
    case Mode::require:
      return "require";
    case Mode::off:
      return "off";
    case Mode::automatic:
      break;
  }
  return "auto";
}

std::string name_of(Update const& wanted) {
  auto const& names = settings::update_frequency.words;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (update_of(static_cast<settings::UpdateFrequency>(i)) == wanted) {
      return std::string(names[i]);
    }
  }
  return std::string(settings::update_frequency.blank);
}

std::string name_of(DeviceChoice const& device) {
  switch (device.kind) {
    case DeviceChoice::Kind::cpu:
      return "cpu";
    case DeviceChoice::Kind::index:
      return std::to_string(device.index);
    case DeviceChoice::Kind::automatic:
      break;
  }
  return "auto";
}

std::string name_of(Lean lean) {
  switch (lean) {
    case Lean::on:
      return "on";
    case Lean::off:
      return "off";
    case Lean::automatic:
      break;
  }
  return "auto";
}

std::string name_of(Method method) {
  switch (method) {
    case Method::patched:
      return "patched";
    case Method::opengl:
      return "opengl";
    case Method::scheduled:
      return "scheduled";
    case Method::automatic:
      break;
  }
  return "auto";
}

std::string name_of(Assets assets) {
  switch (assets) {
    case Assets::any:
      return "any";
    case Assets::restricted:
      break;
  }
  return "restricted";
}

void Choices::fill_from(Choices const& lower) {
  fill(mode, lower.mode);
  if (!resolution && !error) {
    resolution = lower.resolution;
    error = lower.error;
  }
  fill(update, lower.update);
  fill(device, lower.device);
  fill(file, lower.file);
  fill(report, lower.report);
  fill(cache, lower.cache);
  fill(folder, lower.folder);
  fill(start, lower.start);
  fill(lean, lower.lean);
  fill(method, lower.method);
  fill(assets, lower.assets);
  fill(threads, lower.threads);
  fill(quiet, lower.quiet);
  fill(stages, lower.stages);
  fill(task, lower.task);
}

bool Choices::any() const {
  return mode || resolution || error || update || device || file || report || lean || cache ||
         method || assets || threads || quiet;
}

namespace {

std::string suggested(std::string const& flag) {
  std::vector<std::string> flags;
  for (auto const& choice : all_choices()) flags.emplace_back(choice.flag);
  auto const near = did_you_mean(flag, flags);
  return near.empty() ? "; see energyplus --gpu-shading --help" : near;
}

}  // namespace

Choices take_flags(std::vector<std::string>& arguments) {
  Choices choices;
  std::vector<std::string> rest;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    std::string const argument = arguments[i];
    // EnergyPlus has no flags that begin so: others are ours, mistyped.
    if (!argument.starts_with("--gpu")) {
      rest.push_back(argument);
      continue;
    }
    auto const equals = argument.find('=');
    auto const flag = argument.substr(0, equals);
    Choice const* found = nullptr;
    for (auto const& choice : all_choices()) {
      if (choice.flag == flag) found = &choice;
    }
    if (found == nullptr) {
      throw Error(fmt::format("{}: no such flag{}", printable(flag), suggested(flag)));
    }
    std::string value;
    if (equals != std::string::npos) {
      value = argument.substr(equals + 1);
    } else if (found->bare != nullptr) {
      value = found->bare;
    } else if (i + 1 < arguments.size()) {
      value = arguments[++i];
    } else {
      throw Error(fmt::format("{}: a value is missing", flag));
    }
    set(*found, choices, flag, value);
  }
  expect_one_fineness(choices, "--gpu-shading-resolution", "--gpu-shading-error");
  arguments = std::move(rest);
  return choices;
}

std::vector<std::string> to_flags(Choices const& choices) {
  std::vector<std::string> flags;
  auto const add = [&](std::string_view flag, std::string const& value) {
    flags.push_back(fmt::format("{}={}", flag, value));
  };
  if (choices.mode) add("--gpu-shading", name_of(*choices.mode));
  if (choices.resolution) add("--gpu-shading-resolution", std::to_string(*choices.resolution));
  if (choices.error) add("--gpu-shading-error", fmt::format("{}", *choices.error));
  if (choices.update) add("--gpu-shading-update", name_of(*choices.update));
  if (choices.device) add("--gpu-shading-device", name_of(*choices.device));
  if (choices.file) add("--gpu-shading-file", choices.file->string());
  if (choices.report) add("--gpu-shading-report", choices.report->string());
  if (choices.cache) {
    add("--gpu-shading-cache", choices.cache->empty() ? "off" : choices.cache->string());
  }
  if (choices.folder) add("--gpu-shading-model-folder", choices.folder->string());
  if (choices.start) add("--gpu-shading-start-folder", choices.start->string());
  if (choices.lean) add("--gpu-shading-lean", name_of(*choices.lean));
  if (choices.method) add("--gpu-shading-method", name_of(*choices.method));
  if (choices.assets) add("--gpu-shading-assets", name_of(*choices.assets));
  if (choices.threads) add("--gpu-shading-threads", std::to_string(*choices.threads));
  if (choices.quiet) add("--gpu-shading-quiet", *choices.quiet ? "on" : "off");
  if (choices.stages) add("--gpu-shading-stages", choices.stages->string());
  if (choices.task) add("--gpu-shading-task", choices.task->string());
  return flags;
}

void apply_to_process(Choices const& choices) {
  set_quiet(choices.quiet.value_or(false));
  if (!choices.threads) return;
  limit_threads(*choices.threads);
  // OpenImageIO, also in the processes that decode, and Mesa's renderer, which has threads beside
  // the calling one.
  set_variable("OPENIMAGEIO_THREADS", std::to_string(*choices.threads));
  set_variable("LP_NUM_THREADS", std::to_string(*choices.threads - 1));
}

Choices read_environment() {
  Choices choices;
  for (auto const& choice : all_choices()) {
    if (choice.variable == nullptr) continue;
    auto const value = get_variable(choice.variable);
    if (!value.empty()) set(choice, choices, choice.variable, value);
  }
  expect_one_fineness(choices, "GPU_SHADING_RESOLUTION", "GPU_SHADING_ERROR");
  return choices;
}

Choices read_settings(std::vector<InputObject> const& objects) {
  Choices choices;
  for (auto const& object : objects) {
    if (object.type != settings::type) continue;
    for (auto const& choice : all_choices()) {
      if (choice.field == nullptr) continue;
      auto const& value = object[choice.field->key];
      if (value.empty()) continue;
      set(choice, choices, fmt::format("{}: {}", object.where(), choice.field->title), value);
    }
    expect_one_fineness(choices, fmt::format("{}: {}", object.where(), settings::resolution.title),
                        settings::error.title);
  }
  return choices;
}

Options resolve(Choices choices, Choices const& settings, ShadingInput const& input) {
  choices.fill_from(settings);
  Options options;
  options.mode = choices.mode.value_or(Mode::automatic);
  options.resolution = choices.resolution;
  if (!choices.resolution && !choices.error) options.resolution = input.pixel_counting_resolution;
  options.error = choices.error.value_or(Options::default_error);
  options.update = choices.update.value_or(Update{});
  options.device = choices.device.value_or(DeviceChoice{});
  options.report = choices.report;
  options.stages = choices.stages;
  options.lean = choices.lean.value_or(Lean::automatic);
  if (choices.cache && !choices.cache->empty()) options.cache = choices.cache;
  return options;
}

std::string_view flags_help() {
  return R"(GPU shading (each also as an environment variable: GPU_SHADING, GPU_SHADING_RESOLUTION, ...):
  --gpu-shading[=auto|require|off]     Shade by rendering. auto (the bare flag, on, 1): on the CPU
                                       where there is no GPU; require: no GPU is an error; off (0):
                                       stock PolygonClipping, for comparison
  --gpu-shading-error E                What 99 of a hundred sunlit fractions are to be right within,
                                       0.00001 to 0.1 (default: 0.001)
  --gpu-shading-resolution N           Instead: pixels a side of every receiver's tile (default: the
                                       Pixel Counting Resolution of a model that asks for
                                       PixelCounting)
  --gpu-shading-update idf|timestep|sampled:D
                                       How often shading is calculated (default: idf, as the model
                                       asks). sampled:fine, :medium or :coarse: at every timestep, from
                                       samples of the sun's positions over the year; sampled:paper-fine,
                                       :paper-medium or :paper-coarse: from a poorer grid, to compare
  --gpu-shading-device auto|cpu|N      Which device renders (default: auto, a GPU if there is one; N as
                                       gpu_shading devices numbers them)
  --gpu-shading-file F                 Extension objects in a file of their own
                                       (default: MODEL.gpu-shading.idf, where it is)
  --gpu-shading-report DIR             Write a page with the model in 3D, pictures and answers to DIR
  --gpu-shading-lean auto|on|off       Leave shading surfaces that only cast shadows out of what
                                       EnergyPlus reads (default: auto, where there are many)
  --gpu-shading-cache DIR|off          Keep answers in DIR, so that runs of the same geometry render
                                       nothing again (default: off)
  --gpu-shading-method auto|patched|opengl|scheduled
                                       How sunlit fractions get into EnergyPlus: by its redirected
                                       shading functions, through its calls of OpenGL, or as schedules
                                       rendered before the run (default: auto, the first that this
                                       EnergyPlus allows)
  --gpu-shading-assets restricted|any  Which images and meshes are read (default: restricted, to PNG,
                                       JPEG, TIFF, EXR, BMP, TGA, HDR, OBJ, COLLADA and glTF, with
                                       the files beside them that they name). any: all formats of
                                       OpenImageIO and Assimp, with files anywhere
  --gpu-shading-threads N              How many threads compute at a time, at most (default: as many
                                       as there are cores that this process may use)
  --gpu-shading-quiet                  Print nothing but warnings and errors; EnergyPlus's .err still
                                       has all of our messages
)";
}

}  // namespace gpu_shading::energyplus
