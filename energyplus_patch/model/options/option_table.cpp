#include "model/options/option_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "model/extensions/extension_fields.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace settings = extension::settings;

template <std::size_t count>
constexpr FieldInfo choice(std::array<std::string_view, count> const& words,
                           std::string_view blank) {
  return {.key = "", .title = "", .kind = FieldKind::choice, .words = words, .blank = blank};
}

// In the order of the enumerations.
constexpr std::array<std::string_view, 3> mode_words{"auto", "require", "off"};
constexpr std::array<std::string_view, 3> lean_words{"auto", "on", "off"};
constexpr std::array<std::string_view, 4> method_words{"auto", "patched", "opengl", "scheduled"};
constexpr std::array<std::string_view, 2> assets_words{"restricted", "any"};
constexpr std::array<std::string_view, 2> switch_words{"off", "on"};
constexpr std::array<std::string_view, 1> off_word{"off"};

constexpr FieldInfo mode_value = choice(mode_words, "");
constexpr FieldInfo lean_value = choice(lean_words, "auto");
constexpr FieldInfo method_value = choice(method_words, "auto");
constexpr FieldInfo assets_value = choice(assets_words, "restricted");
constexpr FieldInfo switch_value = choice(switch_words, "off");
constexpr FieldInfo path_value{.key = "", .title = ""};
constexpr FieldInfo text_value{.key = "", .title = ""};
constexpr FieldInfo path_or_off_value{.key = "", .title = "", .words = off_word, .blank = "off"};
constexpr FieldInfo gibibytes_value{.key = "",
                                    .title = "",
                                    .kind = FieldKind::real,
                                    .minimum = Limit{0.0, true},
                                    .maximum = Limit{1e6, false}};
constexpr FieldInfo threads_value{.key = "",
                                  .title = "",
                                  .kind = FieldKind::integer,
                                  .minimum = Limit{1.0, false},
                                  .maximum = Limit{4096.0, false}};

// In the order of Update Frequency's words.
std::array<Update, 5> const& updates() {
  using enum Sampling::Density;
  static std::array<Update, 5> const all{{{false},
                                          {true},
                                          {true, Sampling{fine, false}},
                                          {true, Sampling{medium, false}},
                                          {true, Sampling{coarse, false}}}};
  return all;
}

template <typename Value>
Value value_of(FieldInfo const& field, std::string const& text) {
  auto const word = word_index(field, text);
  if constexpr (std::is_same_v<Value, std::filesystem::path>) {
    return word ? std::filesystem::path() : std::filesystem::absolute(text);
  } else if constexpr (std::is_same_v<Value, Update>) {
    return updates().at(word.value());
  } else if constexpr (std::is_same_v<Value, DeviceChoice>) {
    if (!word) return {numbered_device(static_cast<int>(parse_number(text).value()))};
    if (*word == static_cast<std::size_t>(settings::Device::cpu)) return {DeviceId{}};
    return {};
  } else if constexpr (std::is_same_v<Value, bool>) {
    return word.value() != 0;
  } else {
    return detail::Parser<Value>::parse(field, text);
  }
}

std::string text_of(FieldInfo const& field, std::filesystem::path const& value) {
  return std::string(value.empty() ? field.words.front() : value.string());
}

// The paper's grid has an option of its own.
std::string text_of(FieldInfo const& field, Update value) {
  if (value.sampling) value.sampling->paper_grid = false;
  auto const found = std::ranges::find(updates(), value);
  return std::string(field.words[static_cast<std::size_t>(found - updates().begin())]);
}

std::string text_of(FieldInfo const& /*field*/, DeviceChoice const& value) {
  return device_name(value);
}

template <typename Value>
std::string text_of(FieldInfo const& field, Value const& value) {
  if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, bool>) {
    return std::string(field.words[static_cast<std::size_t>(value)]);
  } else {
    return fmt::format("{}", value);
  }
}

// The row with its value in a member of Choices.
template <auto member>
OptionRow at(OptionRow row) {
  row.assign = [](Choices& choices, FieldInfo const& field, std::string const& text) {
    using Value = typename std::decay_t<decltype(choices.*member)>::value_type;
    choices.*member = value_of<Value>(field, text);
  };
  row.text = [](Choices const& choices, FieldInfo const& field) -> std::optional<std::string> {
    if (!(choices.*member)) return std::nullopt;
    return text_of(field, *(choices.*member));
  };
  row.fill = [](Choices& choices, Choices const& lower) {
    if (!(choices.*member)) choices.*member = lower.*member;
  };
  return row;
}

}  // namespace

std::span<OptionRow const> option_rows() {
  using enum Audience;
  static std::array const rows{
      at<&Choices::mode>(
          {.name = "",
           .value = mode_value,
           .default_text = "the official program",
           .meaning = "`auto` (also the flag alone, `on`, `yes`, `true` and `1`): render on a GPU "
                      "if there is one that is not slower, otherwise on the CPU. `require`: stop "
                      "if there is no GPU. "
                      "`off` (also `no`, `false` and `0`): use polygon clipping, for comparison, "
                      "and remove the extension objects from the input",
           .bare = "auto"}),
      at<&Choices::error>(
          {.name = "error",
           .value = settings::error,
           .placeholder = "E",
           .meaning = "Target accuracy: 99 % of sunlit fractions are within this absolute error",
           .in_settings = true}),
      at<&Choices::resolution>(
          {.name = "resolution",
           .value = settings::resolution,
           .placeholder = "N",
           .default_text = "the Pixel Counting Resolution of a model that asks for PixelCounting; "
                           "otherwise set by the error",
           .meaning = "Pixels per side of every receiver's tile, instead of a target accuracy",
           .in_settings = true}),
      at<&Choices::update>(
          {.name = "update",
           .value = settings::update_frequency,
           .meaning = "How often shading is calculated. `idf`: as ShadowCalculation says. "
                      "`timestep`: at every zone timestep. `sampled`: at every zone timestep, "
                      "interpolated between samples of the sun's positions over the year",
           .in_settings = true}),
      at<&Choices::device>(
          {.name = "device",
           .value = settings::device,
           .placeholder = "N",
           .meaning = "The device that renders. `auto`: the first GPU, or the CPU if there is "
                      "none. A number: the device with that number in `gpu_shading devices`",
           .in_settings = true}),
      at<&Choices::file>(
          {.name = "file",
           .value = path_value,
           .placeholder = "FILE",
           .default_text = "`MODEL.gpu-shading.idf` in the model's folder, if present",
           .meaning = "Side file of GPUShading objects"}),
      at<&Choices::report>(
          {.name = "report",
           .value = path_value,
           .placeholder = "DIR",
           .default_text = "none",
           .meaning = "Write a page with the model in 3D and its sunlit fractions by day and hour, "
                      "pictures of what the sun sees, all answers and the time of each stage"}),
      at<&Choices::maps>({.name = "maps",
                          .value = switch_value,
                          .meaning = "Before the run, write `gpu_shading map` and `gpu_shading "
                                     "modules` into the report, whose page shows them",
                          .bare = "on"}),
      at<&Choices::sky>(
          {.name = "sky",
           .value = settings::sky_model,
           .meaning = "Diffuse radiation. `energyplus`: in its isotropic, circumsolar and horizon "
                      "parts. `perez-patches`: by patch of the sky (Perez et al. 1993), at every "
                      "zone timestep",
           .in_settings = true}),
      at<&Choices::reflections>(
          {.name = "reflections",
           .value = settings::reflections,
           .meaning = "Light from the ground, shades and neighbours. `all`: by every path, through "
                      "and between all shades. `energyplus`: as EnergyPlus does, without "
                      "GPUShading objects. `auto`: `all` if the model has GPUShading objects that "
                      "shade, or 20 or more shading surfaces and solar reflections",
           .in_settings = true}),
      at<&Choices::surroundings>(
          {.name = "surroundings",
           .value = switch_value,
           .meaning = "View factors for long-wave exchange by rays, as `gpu_shading export "
                      "--surroundings` writes them",
           .bare = "on"}),
      at<&Choices::pv>({.name = "pv",
                        .value = path_value,
                        .placeholder = "FILE",
                        .default_text = "none",
                        .meaning = "Reductions of the sunlit fraction of photovoltaic surfaces, by "
                                   "partly shaded cells"}),
      at<&Choices::cache>(
          {.name = "cache",
           .value = path_or_off_value,
           .placeholder = "DIR",
           .meaning = "Keep answers in this folder, so that later runs of the same geometry need "
                      "not render them"}),
      at<&Choices::cache_size>({.name = "cache-size",
                                .value = gibibytes_value,
                                .placeholder = "GIB",
                                .default_text = "1",
                                .meaning = "The most that the folder of the cache takes, in GiB: "
                                           "above it, the least recently used files are evicted"}),
      at<&Choices::cache_read_only>(
          {.name = "cache-read-only",
           .value = switch_value,
           .meaning = "Write nothing into the cache: for a folder of others",
           .bare = "on"}),
      at<&Choices::positions>(
          {.name = "positions",
           .value = text_value,
           .placeholder = "NAME=POSITION,...",
           .default_text = "as in the model",
           .meaning =
               "Positions at rest of moving shades, which pictures, maps, masks and samples show"}),
      at<&Choices::threads>({.name = "threads",
                             .value = threads_value,
                             .placeholder = "N",
                             .default_text = "all cores that the process may use",
                             .meaning = "Maximum number of threads"}),
      at<&Choices::quiet>(
          {.name = "quiet",
           .value = switch_value,
           .meaning = "Print only warnings and errors; EnergyPlus's .err file has all messages",
           .bare = "on"}),
      at<&Choices::verbose>({.name = "verbose",
                             .value = switch_value,
                             .meaning = "Print the time of each stage of rendering, too",
                             .bare = "on"}),
      at<&Choices::lean>(
          {.name = "lean",
           .value = lean_value,
           .meaning = "Hide shading surfaces that only cast shadows from EnergyPlus. `auto`: if "
                      "there are 100 or more, and otherwise only those that EnergyPlus would "
                      "distort. `on`: any number",
           .audience = experts}),
      at<&Choices::method>(
          {.name = "method",
           .value = method_value,
           .meaning = "How sunlit fractions reach EnergyPlus. `patched`: by its redirected shading "
                      "functions. `opengl`: through its calls of OpenGL. `scheduled`: as schedules "
                      "rendered before the run. `auto`: the first of these that this EnergyPlus "
                      "allows",
           .audience = experts}),
      at<&Choices::assets>(
          {.name = "assets",
           .value = assets_value,
           .meaning = "Which images and meshes are read. `restricted`: PNG, JPEG, TIFF, EXR, BMP, "
                      "TGA, HDR, OBJ, COLLADA and glTF, with the files in the same folder that "
                      "they name. `any`: all formats of OpenImageIO and Assimp, with files "
                      "anywhere",
           .audience = experts}),
      at<&Choices::stages>({.name = "stages",
                            .value = path_value,
                            .placeholder = "FILE",
                            .default_text = "none",
                            .meaning = "A table of the time of each stage, for compare_shading",
                            .audience = scripts}),
      at<&Choices::paper_grid>(
          {.name = "paper-grid",
           .value = switch_value,
           .meaning = "Sample on the grid of Jones & Greenberg, for compare_sampling",
           .audience = scripts,
           .bare = "on"}),
      at<&Choices::folder>({.name = "model-folder",
                            .value = path_value,
                            .placeholder = "DIR",
                            .default_text = "the model's",
                            .meaning = "Folder of relative file names in the model",
                            .audience = programs}),
      at<&Choices::start>({.name = "start-folder",
                           .value = path_value,
                           .placeholder = "DIR",
                           .default_text = "the current folder",
                           .meaning = "Where the user started EnergyPlus",
                           .audience = programs}),
      at<&Choices::surrounding_objects>({.name = "surrounding-objects",
                                         .value = path_value,
                                         .placeholder = "FILE",
                                         .default_text = "none",
                                         .meaning = "Objects of --gpu-shading-surroundings",
                                         .audience = programs}),
      at<&Choices::task>({.name = "task",
                          .value = path_value,
                          .placeholder = "FILE",
                          .default_text = "none",
                          .meaning = "Run EnergyPlus only for the task in this file",
                          .audience = programs})};
  return rows;
}

std::string OptionRow::flag() const {
  return fmt::format("--gpu-shading{}{}", name.empty() ? "" : "-", name);
}

std::string OptionRow::variable() const {
  if (audience == Audience::programs) return {};
  auto variable = upper(flag().substr(2));
  std::ranges::replace(variable, '-', '_');
  return variable;
}

}  // namespace gpu_shading::energyplus
