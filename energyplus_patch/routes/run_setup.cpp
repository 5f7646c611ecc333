#include "routes/run_setup.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "answers/cache_folder.h"
#include "gpu_shading/error.h"
#include "model/idf/model_text.h"
#include "model/options/report_folder.h"
#include "platform/naming.h"

namespace gpu_shading::energyplus {

RunSetup::RunSetup(std::vector<std::string>& command)
    : choices(take_flags(command)), arguments(command) {
  auto const environment = read_environment();
  wanted = choices.any() || environment.mode;
  choices.fill_from(environment);
  if (wanted) apply_to_process(choices);
  line = read_command_line(arguments);
}

bool RunSetup::has_model() const {
  return line.model && std::filesystem::exists(*line.model) &&
         (is_idf(*line.model) || is_epjson(*line.model));
}

EnergyPlusCall RunSetup::call(std::filesystem::path const& program) const {
  return {program, line.model.value(), line.weather, line.expand, line.annual, line.design_days};
}

std::vector<std::string> RunSetup::arguments_for(std::filesystem::path const& model) const {
  auto changed = arguments;
  if (line.model_at) {
    changed[*line.model_at] = model.string();
  } else {
    changed.push_back(model.string());
  }
  return changed;
}

std::string rewrite_idf_model(std::string const& text, std::filesystem::path const& path,
                              TakeModel const& take) {
  auto const parsed = parse_idf(text);
  auto const find = [&](Names const& names) { return find_mentions(parsed, names); };
  auto objects = naming(path.string(), [&] {
    check_idf_text(text, parsed);
    return read_idf(parsed);
  });
  return rewrite_idf(text, parsed, take(std::move(objects), find));
}

void rewrite_epjson_model(nlohmann::json& json, std::filesystem::path const& path,
                          TakeModel const& take) {
  auto const find = [&](Names const& names) { return find_mentions(json, names); };
  auto objects = naming(path.string(), [&] {
    check_epjson(json);
    return read_epjson(json);
  });
  rewrite_epjson(json, take(std::move(objects), find));
}

void prepare_folders(Options const& options, bool report) {
  if (options.cache) prepare_cache_folder(*options.cache);
  if (options.report && report) prepare_report(*options.report);
}

void refuse_surroundings(Choices const& choices) {
  if (!choices.surroundings.value_or(false) || choices.surrounding_objects || choices.task) return;
  throw Error(
      "--gpu-shading-surroundings: only the program energyplus for Linux applies it; expected the "
      "objects of gpu_shading export --surroundings in the model");
}

}  // namespace gpu_shading::energyplus
