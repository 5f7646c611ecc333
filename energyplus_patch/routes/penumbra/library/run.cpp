#include "routes/penumbra/library/run.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "gpu_shading/error.h"
#include "gpu_shading_answers.h"
#include "model/idf/model_file.h"
#include "platform/console.h"
#include "platform/error_line.h"
#include "platform/naming.h"
#include "routes/penumbra/library/model_calculation.h"
#include "routes/penumbra/library/opaque_calculation.h"

namespace gpu_shading::energyplus {
namespace {

// Returns what EnergyPlus is to read instead of the model.
Rewrite take_model(std::vector<InputObject> objects, std::filesystem::path const& path,
                   std::string const& version, MentionFinder const& find_mentions) {
  auto& run = source_run();
  constexpr bool daylight_rays = true;
  auto model = understand(std::move(objects), path, run.choices, {find_mentions, daylight_rays});
  if (model.options.mode != Mode::off) {
    check_supported(model.shading, version);
    // Now, because EnergyPlus may stop at such a surface.
    if (auto const& warning = model.simplified.warning; !warning.empty()) {
      print_line("warning: " + warning);
    }
    run.model = std::move(model);
    return rewrite_for(*run.model);
  }
  return rewrite_for(model);
}

std::string read_epjson_text(std::string const& text, std::filesystem::path const& path,
                             std::string const& version) {
  auto json = parse_epjson(text);
  auto const find = [&](Names const& names) { return find_mentions(json, names); };
  auto objects = naming(path.string(), [&] { return read_epjson(json); });
  rewrite_epjson(json, take_model(std::move(objects), path, version, find));
  return json.dump();
}

std::string read_idf_text(std::string const& text, std::filesystem::path const& path,
                          std::string const& version) {
  auto const parsed = parse_idf(text);
  auto const find = [&](Names const& names) { return find_mentions(parsed, names); };
  auto objects = naming(path.string(), [&] { return read_idf(parsed); });
  return rewrite_idf(text, parsed, take_model(std::move(objects), path, version, find));
}

// EnergyPlus itself asks this library, which is no choice.
void warn_of_method(Choices const& choices) {
  auto const method = choices.method.value_or(Method::automatic);
  if (method == Method::automatic) return;
  print_line(
      fmt::format("warning: --gpu-shading-method {}: ignored, because this EnergyPlus was compiled "
                  "with gpu_shading",
                  name_of(method)));
}

}  // namespace

SourceRun& source_run() {
  thread_local SourceRun run;
  return run;
}

}  // namespace gpu_shading::energyplus

namespace gpu_shading::answers {

using energyplus::source_run;

Calculation::~Calculation() = default;

std::unique_ptr<Calculation> make_calculation(unsigned size, Log log) {
  if (auto const& model = source_run().model) {
    return std::make_unique<energyplus::ModelCalculation>(*model, std::move(log));
  }
  return std::make_unique<energyplus::OpaqueCalculation>(size, std::move(log));
}

std::vector<std::string> take_options(std::vector<std::string> arguments) {
  auto& run = source_run();
  run = {};
  try {
    run.choices = energyplus::take_flags(arguments);
    auto const environment = energyplus::read_environment();
    run.wanted = run.choices.any() || environment.mode;
    run.choices.fill_from(environment);
    if (run.wanted) {
      energyplus::warn_of_method(run.choices);
      energyplus::apply_to_process(run.choices);
    }
  } catch (std::exception const& error) {
    run.wanted = true;
    run.wrong = energyplus::error_line(error);
    // EnergyPlus would not know them, and say so instead.
    std::erase_if(arguments, [](auto const& each) { return each.starts_with("--gpu-shading"); });
  }
  return arguments;
}

std::string options_help() { return energyplus::options_help(); }

bool is_wanted() { return source_run().wanted; }

std::string read_model(std::string text, Format format, std::string const& path,
                       std::string const& version) {
  auto& run = source_run();
  if (!run.wrong.empty()) throw Error(run.wrong);
  if (!run.wanted) return text;
  return format == Format::idf ? energyplus::read_idf_text(text, path, version)
                               : energyplus::read_epjson_text(text, path, version);
}

}  // namespace gpu_shading::answers
