#include "model/options/options.h"

#include <fmt/format.h>

#include <algorithm>

#include "gpu_shading/error.h"
#include "gpu_shading/renderer.h"
#include "model/extensions/extension_fields.h"
#include "model/extensions/field.h"
#include "model/options/option_table.h"
#include "platform/console.h"
#include "platform/process.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace settings = extension::settings;

bool is_one_of(std::string const& text, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return same_name(text, word); });
}

// Flags without a value are switches, which accept the usual words for on and off.
std::string switch_word(OptionRow const& row, std::string const& text) {
  if (is_one_of(text, {"on", "yes", "true", "1"})) return std::string(row.bare);
  return is_one_of(text, {"off", "no", "false", "0"}) ? "off" : text;
}

// `source`: the name that the user gave the option.
void set(OptionRow const& row, Choices& choices, std::string_view source, std::string text) {
  if (!row.bare.empty()) text = switch_word(row, text);
  if (text.empty()) throw Error(fmt::format("{} is blank, expected {}", source, row.expectation()));
  check(row.value, text, source);
  row.assign(choices, row.value, text);
}

void expect_one_fineness(Choices const& choices, std::string_view resolution,
                         std::string_view error) {
  if (choices.resolution && choices.error) {
    throw Error(fmt::format("{} and {} are both given, expected one of them", resolution, error));
  }
}

OptionRow const& row_of(std::string const& flag) {
  auto const rows = option_rows();
  auto const found = std::ranges::find(rows, flag, &OptionRow::flag);
  if (found != rows.end()) return *found;
  std::vector<std::string> flags;
  for (auto const& row : rows) flags.push_back(row.flag());
  auto const near = did_you_mean(flag, flags);
  throw Error(fmt::format("{}: no such flag{}", printable(flag),
                          near.empty() ? "; see energyplus --gpu-shading --help" : near));
}

template <typename Value>
std::string name_in(std::optional<Value> Choices::*member, Value const& value) {
  Choices choices;
  choices.*member = value;
  auto const flag = to_flags(choices).front();
  return flag.substr(flag.find('=') + 1);
}

}  // namespace

std::string name_of(Update const& update) { return name_in(&Choices::update, update); }
std::string name_of(Method method) { return name_in(&Choices::method, method); }

void Choices::fill_from(Choices const& lower) {
  auto rest = lower;
  if (resolution || error) rest.resolution = {}, rest.error = {};
  for (auto const& row : option_rows()) row.fill(*this, rest);
}

bool Choices::any() const {
  auto const rows = option_rows();
  return std::ranges::any_of(rows, [&](OptionRow const& row) {
    return row.audience <= Audience::experts && row.text(*this, row.value);
  });
}

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
    auto const& row = row_of(flag);
    std::string value(row.bare);
    if (equals != std::string::npos) {
      value = argument.substr(equals + 1);
    } else if (row.bare.empty()) {
      if (i + 1 == arguments.size()) throw Error(fmt::format("{}: a value is missing", flag));
      value = arguments[++i];
    }
    set(row, choices, flag, value);
  }
  expect_one_fineness(choices, "--gpu-shading-resolution", "--gpu-shading-error");
  arguments = std::move(rest);
  return choices;
}

std::vector<std::string> to_flags(Choices const& choices) {
  std::vector<std::string> flags;
  for (auto const& row : option_rows()) {
    auto const value = row.text(choices, row.value);
    if (value) flags.push_back(fmt::format("{}={}", row.flag(), *value));
  }
  return flags;
}

void apply_to_process(Choices const& choices) {
  set_quiet(choices.quiet.value_or(false));
  if (!choices.threads) return;
  limit_threads(*choices.threads);
  // OpenImageIO, also in the processes that decode, and Mesa's renderer, which has threads besides
  // the calling one.
  set_variable("OPENIMAGEIO_THREADS", std::to_string(*choices.threads));
  set_variable("LP_NUM_THREADS", std::to_string(*choices.threads - 1));
}

Choices read_environment() {
  Choices choices;
  for (auto const& row : option_rows()) {
    auto const variable = row.variable();
    auto const value = variable.empty() ? "" : get_variable(variable.c_str());
    if (!value.empty()) set(row, choices, variable, value);
  }
  expect_one_fineness(choices, "GPU_SHADING_RESOLUTION", "GPU_SHADING_ERROR");
  return choices;
}

Choices read_settings(std::vector<InputObject> const& objects) {
  Choices choices;
  for (auto const& object : objects) {
    if (object.type != settings::type) continue;
    for (auto const& row : option_rows()) {
      if (!row.in_settings) continue;
      auto const& value = object[row.value.key];
      if (value.empty()) continue;
      set(row, choices, fmt::format("{}: {}", object.where(), row.value.title), value);
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
  if (options.update.sampling) {
    options.update.sampling->paper_grid = choices.paper_grid.value_or(false);
  }
  options.device = choices.device.value_or(DeviceChoice{});
  options.report = choices.report;
  options.stages = choices.stages;
  options.lean = choices.lean.value_or(Lean::automatic);
  options.sky = choices.sky.value_or(SkyModel::energyplus);
  options.reflections = choices.reflections.value_or(Reflections::automatic);
  options.verbose = choices.verbose.value_or(false);
  if (choices.cache && !choices.cache->empty()) {
    auto& cache = options.cache.emplace(CacheFolder{*choices.cache});
    if (choices.cache_size) {
      constexpr double gibibyte = 1 << 30;
      cache.max_bytes = static_cast<std::uint64_t>(*choices.cache_size * gibibyte);
    }
    cache.read_only = choices.cache_read_only.value_or(false);
  }
  return options;
}

}  // namespace gpu_shading::energyplus
