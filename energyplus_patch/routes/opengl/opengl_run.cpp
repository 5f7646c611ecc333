#include "routes/opengl/opengl_run.h"

#include <array>
#include <cstdlib>
#include <glm/trigonometric.hpp>
#include <memory>
#include <string_view>
#include <utility>

#include "gpu_shading/error.h"
#include "model/energyplus_rays.h"
#include "model/idf/model_editor.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/error_line.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/process.h"
#include "routes/hosted_run.h"
#include "routes/opengl/opengl_functions.h"
#include "routes/opengl/schedule_clock.h"
#include "routes/schedules/rendered_run.h"
#include "runs/drawing.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

// The user's model, and the text that EnergyPlus is to read instead.
struct HostedText {
  Model model;
  std::string text;
  std::shared_ptr<AskedTask> task;  // that EnergyPlus is run for, if it is
};

// The same, as EnergyPlus runs it.
struct HostedModel {
  std::filesystem::path path;  // in a folder for this run
  DrawnModel::Input input;     // without `named` where nothing is rendered
  RunMessages messages;
};

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
  if (auto const warning = warn_of_actuated(model)) {
    print_line("warning: " + *warning);
    hosted.messages.warnings.push_back(*warning);
  }
  bool const every_day = model.shading.every_timestep || model.options.update.every_timestep;
  auto const clock = std::make_shared<ScheduleClock>(
      std::move(days), every_day ? 1 : model.shading.update_days, hosted_day);
  hosted.input.simulation.schedules = {
      [clock](std::string const& name) { return clock->range(name); },
      [clock](std::string const& name, Moment moment) { return clock->value(name, moment); }};
  hosted.input.time_of = [clock](glm::dvec3 const& sun) { return clock->moment_of(sun); };
}

HostedText read_hosted(Path const& path, Choices const& choices) {
  auto task = choices.task ? std::make_shared<AskedTask>(*choices.task) : nullptr;
  auto text = read_text_file(path);
  std::optional<Model> model;
  auto const take = [&](std::vector<InputObject> objects, MentionFinder const& find) {
    model = naming(path.string(), [&] {
      Reader reader{find};
      reader.release = read_release(own_folder());
      reader.reflected_light = choices.task == std::nullopt;
      return understand(std::move(objects), path, choices, reader);
    });
    return rewrite_for(*model);
  };
  if (is_epjson(path)) {
    auto json = naming(path.string(), [&] { return parse_epjson(text); });
    rewrite_epjson_model(json, path, take);
    text = json.dump(1);
  } else {
    text = rewrite_idf_model(text, path, take);
  }
  return {std::move(model.value()), std::move(text), std::move(task)};
}

// Traces the reflected light of a run, and passes it by schedules of the edited model at
// hosted.path.
void add_grounds(ModelEditor& editor, HostedModel& hosted, Model const& model,
                 EnergyPlusCall const& call) {
  auto const& light = model.reflected_light;
  if (light.receivers.empty()) return;
  auto& lines = hosted.messages;
  Messages const messages{[&](std::string const& line) { lines.warnings.push_back(line); },
                          [&](std::string const& line) { lines.remarks.push_back(line); },
                          [](std::string const&) {}};
  auto const made =
      render_run(model, hosted.input.named, run_for_times(call, shade_schedules(model), Dates::all),
                 messages, hosted.input.simulation.latitude, Rendered::grounds);
  add_ground_schedules(editor, light, made.grounds, hosted.path.parent_path());
  write_whole_file(hosted.path, [&](std::ostream& out) { out << editor.text(); });
}

// Writes the model into `folder`, and has EnergyPlus list its surfaces. `call`: with the user's
// model.
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
  for (auto const& warning : model.early_warnings) {
    print_line("warning: " + warning);
    hosted.messages.warnings.push_back(warning);
  }
  call.model = hosted.path;
  add_schedules(hosted, model, call);
  hosted.input.named = surfaces_of(run_for_surfaces(call), model.shading);
  hosted.input.simulation.messages = messages_of_run(read.task);
  hosted.input.task = read.task;
  hosted.input.simulation.latitude = [weather = call.weather] {
    if (!weather) throw Error("-w: a weather file is required (it sets the site)");
    return glm::radians(read_weather_site(*weather).latitude);
  };
  if (!read.task) add_grounds(*editor, hosted, model, call);
  hosted.input.model = std::move(model);
  hosted.input.model.reflected_light.receivers.clear();
  return hosted;
}

constexpr char const* method_line =
    "sunlit fractions are passed to EnergyPlus through its calls of OpenGL";

}  // namespace

int run_by_opengl(Path const& library, Path const& program, RunSetup const& setup) {
  auto read = read_hosted(setup.line.model.value(), setup.choices);
  prepare_folders(read.model.options, read.task == nullptr);
  TemporaryFolder const folder;
  auto hosted = prepare_hosted(std::move(read), setup.call(program), folder.path());
  if (!hosted.input.named.empty()) {
    print_line(method_line);
    hosted.messages.remarks.emplace_back(method_line);
    draw_with(std::move(hosted.input));
  }
  int const status = run_hosted(library, setup.arguments_for(hosted.path), hosted.messages);
  try {
    finish_drawing();
  } catch (std::exception const& error) {
    // EnergyPlus has written its results: this is no run that was refused.
    print_line("error: " + error_line(error));
    return EXIT_FAILURE;
  }
  return status;
}

}  // namespace gpu_shading::energyplus
