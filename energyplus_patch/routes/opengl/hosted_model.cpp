#include "routes/opengl/hosted_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/trigonometric.hpp>
#include <memory>
#include <string_view>
#include <utility>

#include "gpu_shading/error.h"
#include "model/daylighting.h"
#include "model/idf/model_editor.h"
#include "model/idf/model_file.h"
#include "model/model_reader.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/process.h"
#include "routes/opengl/schedule_clock.h"
#include "routes/schedules/rendered_fractions.h"
#include "runs/drawing.h"
#include "runs/installation.h"
#include "runs/short_runs.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

Messages messages_of_run(std::shared_ptr<AskedTask> const& task) {
  return {[task](std::string const& line) {
            print_line("warning: " + line);
            warn_hosted_run(line);
            if (task) task->warn(line);
          },
          [](std::string const& line) {
            print_line(line);
            tell_hosted_run(line);
          },
          [](std::string const&) {}};
}

// EnergyPlus calls its own pixel counting blind to Transmittance Schedules, in a Severe message.
// They stay where its own rays need them, and where they tell it to look at the sky at each time.
void remove_schedules(ModelEditor& editor, Model const& model) {
  if (model.shading.reflections || model.shading.detailed_sky) return;
  bool rays = false;
  for (auto const type : daylighting_types) {
    editor.edit(type, [&](EditedObject const&) { rays = true; });
  }
  if (rays) return;
  constexpr std::string_view name = "transmittance_schedule_name";
  constexpr std::array<std::pair<std::string_view, FieldPosition>, 3> fields{
      {{"Shading:Site:Detailed", {1, name}},
       {"Shading:Building:Detailed", {1, name}},
       {"Shading:Zone:Detailed", {2, name}}}};
  for (auto const& each : fields) {
    editor.edit(each.first, [&](EditedObject& shade) {
      if (!shade.get(each.second).empty()) shade.set(each.second, "");
    });
  }
}

// What the session reads schedules by.
void add_schedules(HostedModel& hosted, Model const& model, EnergyPlusCall const& call) {
  auto const names = shade_schedules(model);
  if (names.empty()) return;
  auto days = run_for_schedules(call, names);
  std::vector<std::string> unknown;
  for (auto const& name : names) {
    bool const known =
        std::find(days.schedules.begin(), days.schedules.end(), name) != days.schedules.end();
    if (!known || model.shading.actuated.contains(name)) unknown.push_back(name);
  }
  if (!unknown.empty()) {
    auto const warning = describe_unknown(unknown);
    print_line("warning: " + warning);
    hosted.messages.warnings.push_back(warning);
  }
  bool const every_day = model.shading.every_timestep || model.options.update.every_timestep;
  auto const clock = std::make_shared<ScheduleClock>(
      std::move(days), every_day ? 1 : model.shading.update_days, hosted_day);
  hosted.input.schedules = {
      [clock](std::string const& name) { return clock->range(name); },
      [clock](std::string const& name, Moment moment) { return clock->value(name, moment); }};
  hosted.input.time_of = [clock](glm::dvec3 const& sun) { return clock->moment_of(sun); };
}

}  // namespace

HostedText read_hosted(Path const& path, Choices const& choices) {
  auto const task = choices.task ? std::make_shared<AskedTask>(*choices.task) : nullptr;
  auto text = read_text_file(path);
  return naming(path.string(), [&]() -> HostedText {
    if (is_epjson(path)) {
      auto json = parse_epjson(text);
      auto const find = [&](Names const& names) { return find_mentions(json, names); };
      auto model = understand(read_epjson(json), path, choices, {find, false});
      rewrite_epjson(json, rewrite_for(model));
      return {std::move(model), json.dump(1), task};
    }
    auto const parsed = parse_idf(text);
    auto const find = [&](Names const& names) { return find_mentions(parsed, names); };
    auto model = understand(read_idf(parsed), path, choices, {find, false});
    text = rewrite_idf(text, parsed, rewrite_for(model));
    return {std::move(model), std::move(text), task};
  });
}

HostedModel prepare_hosted(HostedText read, EnergyPlusCall call, Path const& folder) {
  auto& model = read.model;
  auto const original = std::filesystem::absolute(call.model);
  // Under its own name, which is what the editor knows its kind from.
  auto const rewritten = folder / "rewritten" / original.filename();
  std::filesystem::create_directories(rewritten.parent_path());
  write_whole_file(rewritten, [&](std::ostream& file) { file << read.text; });
  HostedModel hosted;
  auto const editor = edit_model(rewritten);
  bool const renders = model.options.mode != Mode::off;
  if (renders) remove_schedules(*editor, model);
  hosted.path = place_model(*editor, original, folder / "model");
  if (!renders) return hosted;
  check_supported(model.shading, read_version(own_folder()));
  if (auto const& warning = model.simplified.warning; !warning.empty()) {
    print_line("warning: " + warning);
    hosted.messages.warnings.push_back(warning);
  }
  call.model = hosted.path;
  add_schedules(hosted, model, call);
  hosted.input.named = surfaces_of(run_for_surfaces(call), model.shading);
  hosted.input.model = std::move(model);
  hosted.input.messages = messages_of_run(read.task);
  hosted.input.task = read.task;
  hosted.input.latitude = [weather = call.weather] {
    if (!weather) throw Error("-w: a weather file is required (it sets the site)");
    return glm::radians(read_weather_site(*weather).latitude);
  };
  return hosted;
}

}  // namespace gpu_shading::energyplus
