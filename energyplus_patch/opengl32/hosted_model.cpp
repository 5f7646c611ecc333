#include "opengl32/hosted_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <utility>

#include "base/console.h"
#include "base/files.h"
#include "base/naming.h"
#include "gpu_shading/error.h"
#include "idf/model_editor.h"
#include "idf/model_file.h"
#include "model/model_reader.h"
#include "runs/drawn_surfaces.h"
#include "runs/installation.h"
#include "runs/short_runs.h"
#include "site/weather_site.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

constexpr char const* official_program = "energyplus-official.exe";

Rewrite rewrite_for(Model const& model) {
  return {model.options.mode == Mode::off ? "PolygonClipping" : "PixelCounting",
          model.options.update.every_timestep ? "Timestep" : "", model.lean.left_out,
          model.lean.placeholders};
}

struct Understood {
  Model model;
  std::string text;  // for EnergyPlus
};

Understood understand_file(Path const& path, Choices const& choices) {
  auto text = read_text_file(path);
  return naming(path.string(), [&]() -> Understood {
    if (is_epjson(path)) {
      auto json = parse_epjson(text);
      auto const find = [&](Names const& names) { return find_mentions(json, names); };
      auto model = understand(read_epjson(json), path, choices, {find, false});
      rewrite_epjson(json, rewrite_for(model));
      return {std::move(model), json.dump(1)};
    }
    auto const parsed = parse_idf(text);
    auto const find = [&](Names const& names) { return find_mentions(parsed, names); };
    auto model = understand(read_idf(parsed), path, choices, {find, false});
    text = rewrite_idf(text, parsed, rewrite_for(model));
    return {std::move(model), std::move(text)};
  });
}

void write(Path const& path, std::string const& text) {
  write_whole_file(path, [&](std::ostream& file) { file << text; });
}

Messages messages_of_run() {
  return {[](std::string const& line) {
            print_line("warning: " + line);
            warn_hosted_run(line);
          },
          [](std::string const& line) {
            print_line(line);
            tell_hosted_run(line);
          },
          [](std::string const&) {}};
}

}  // namespace

bool has_schedules(Model const& model) {
  auto const& surfaces = model.shading.shading_surfaces;
  auto const& screens = model.screens.by_surface;
  return std::any_of(
             surfaces.begin(), surfaces.end(),
             [](auto const& each) { return !each.second.transmittance_schedule.empty(); }) ||
         std::any_of(screens.begin(), screens.end(),
                     [](auto const& each) { return !each.second.deployment_schedule.empty(); });
}

Model read_hosted(Path const& path, Choices const& choices) {
  return understand_file(path, choices).model;
}

HostedModel prepare_hosted(CommandLine const& line, Choices const& choices, Path const& folder) {
  auto const original = std::filesystem::absolute(*line.model);
  auto [model, text] = understand_file(original, choices);
  HostedModel hosted;
  hosted.path = folder / original.filename();
  write(hosted.path, text);
  // Names of files in the model are relative to it.
  auto const editor = edit_model(hosted.path);
  editor->anchor_paths(original.parent_path());
  write(hosted.path, editor->text());
  if (model.options.mode == Mode::off) return hosted;
  check_supported(model.shading, read_version(own_folder()));
  if (auto const& warning = model.simplified.warning; !warning.empty()) {
    print_line("warning: " + warning);
    hosted.messages.warnings.push_back(warning);
  }
  auto const drawing = run_for_surfaces({own_folder() / official_program, hosted.path, line.weather,
                                         line.expand, line.annual, line.design_days});
  hosted.input.named = surfaces_of(drawing, model.shading);
  hosted.input.model = std::move(model);
  hosted.input.messages = messages_of_run();
  hosted.input.latitude = [weather = line.weather] {
    if (!weather) throw Error("-w: a weather file is required (it sets the site)");
    return glm::radians(read_weather_site(*weather).latitude);
  };
  return hosted;
}

}  // namespace gpu_shading::energyplus
