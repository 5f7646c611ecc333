#include "routes/schedules/scheduled_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/local_environment.h"
#include "model/idf/model_editor.h"
#include "model/site/weather_header.h"
#include "platform/console.h"
#include "platform/files.h"
#include "platform/process.h"
#include "platform/text.h"
#include "routes/hosted_run.h"
#include "routes/schedules/rendered_run.h"
#include "runs/drawing.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

constexpr FieldPosition exterior_surface{1, "exterior_surface_name"};
constexpr FieldPosition sunlit_schedule{2, "sunlit_fraction_schedule_name"};

// The warning about what the scheduled method cannot do.
std::string describe_limits(Model const& model) {
  std::string text =
      "scheduled sunlit fractions apply to the beam in run periods only: EnergyPlus "
      "computes the sky's diffuse light and sizing periods by polygon clipping, and spreads the "
      "beam through windows over interior surfaces instead of tracing it";
  if (!model.shades.by_surface.empty() || !model.screens.by_surface.empty()) {
    text += "; GPUShading objects are opaque to the sky's diffuse light";
  }
  if (model.shading.all_shading_wanted || !model.shading.wanted_shading.empty()) {
    text += "; shading surfaces themselves count as sunlit";
  }
  if (!model.reflected_light.receivers.empty()) {
    text +=
        "; a sizing period on a date of the run periods divides what reflected light reaches a "
        "surface as they do";
  }
  if (model.options.lean == Lean::on) text += "; lean input is off";
  return text;
}

class Collected {
 public:
  explicit Collected(Say say) : say_(std::move(say)) {}

  void warn(std::string const& line) {
    say_("warning: " + line);
    warnings.push_back(line);
  }
  void remark(std::string const& line) {
    say_(line);
    remarks.push_back(line);
  }
  Messages messages() {
    return {[this](std::string const& line) { warn(line); },
            [this](std::string const& line) { remark(line); }, [](std::string const&) {}};
  }

  std::vector<std::string> warnings;
  std::vector<std::string> remarks;

 private:
  Say say_;
};

// Latitude of the site that determines the sun in run periods; radians.
double latitude_of(EnergyPlusCall const& call) {
  if (!call.weather)
    throw Error("-w: a weather file is required (it sets the site at which the sun is sampled)");
  return glm::radians(read_weather_site(*call.weather).latitude);
}

RenderedRun render(EnergyPlusCall const& call, Model model, Rendered wanted, Collected& out) {
  bool const reflects = !model.reflected_light.receivers.empty();
  if (wanted == Rendered::grounds && !reflects) return {};
  auto const run =
      run_for_times(call, shade_schedules(model), reflects ? Dates::all : Dates::of_run_periods);
  if (run.times.empty()) return {};
  if (auto const warning = warn_of_actuated(model)) out.warn(*warning);
  auto const surfaces = surfaces_of(run_for_surfaces(call), model.shading);
  return render_run(
      std::move(model), surfaces, run, out.messages(), [&] { return latitude_of(call); }, wanted);
}

// `file`: beside the model, so that both can be copied together.
void add_sunlit_schedules(ModelEditor& editor, ScheduleTable const& table,
                          std::string const& file) {
  constexpr std::string_view limits = "GPU SHADING SUNLIT FRACTION";
  editor.add({"ScheduleTypeLimits",
              {{"name", limits},
               {"lower_limit_value", 0},
               {"upper_limit_value", 1},
               {"numeric_type", "Continuous"}}});
  std::unordered_map<std::string, std::string> schedule_of;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    auto const name = fmt::format("{} {}", limits, i + 1);
    schedule_of[upper(table.columns[i])] = name;
    editor.add(file_schedule(table, i, name, std::string(limits), file));
  }
  // A surface may already have the object for other properties.
  editor.edit(local_environment, [&](EditedObject& object) {
    auto const found = schedule_of.find(upper(object.get(exterior_surface)));
    if (found == schedule_of.end()) return;
    object.set(sunlit_schedule, found->second);
    schedule_of.erase(found);
  });
  for (auto const& surface : table.columns) {
    auto const found = schedule_of.find(upper(surface));
    if (found == schedule_of.end()) continue;
    editor.add(environment_object({.name = found->second + " OF ITS SURFACE",
                                   .surface = surface,
                                   .sunlit_schedule = found->second}));
  }
}

}  // namespace

ScheduledModel prepare_scheduled(EnergyPlusCall const& call, Choices const& choices,
                                 Path const& folder, Say const& say) {
  Collected out(say);
  auto const editor = edit_model(call.model);
  editor->remove([](std::string_view type) { return is_extension(type); });
  Reader reader;
  reader.release = read_release(call.program.parent_path());
  reader.reflected_light = true;
  auto model = read_model(call.model, choices, reader);
  if (model.surrounding_objects) editor->merge(read_text_file(*model.surrounding_objects));
  if (model.options.mode == Mode::off) {
    editor->apply(shading_method("PolygonClipping"));
  } else {
    for (auto const& warning : model.early_warnings) out.warn(warning);
    out.warn(describe_limits(model));
    editor->apply(model.field_changes);
    for (auto const& object : model.new_objects) editor->add(object);
    auto const light = model.reflected_light;
    auto const wanted = runs_periods(call, *editor) ? Rendered::all : Rendered::grounds;
    auto const made = render(call, std::move(model), wanted, out);
    if (!light.receivers.empty()) add_ground_schedules(*editor, light, made.grounds, folder);
    if (made.sunlit.empty()) {
      out.warn(
          "no run period with the sun above the horizon is run: all shading is computed by polygon "
          "clipping");
      editor->apply(shading_method("PolygonClipping"));
    } else {
      // With Periodic, a day's schedule values would apply to the whole period.
      editor->apply(shading_method("Scheduled", "Timestep"));
      constexpr char const* fractions = "gpu_shading_sunlit.csv";
      write_whole_file(folder / fractions,
                       [&](std::ostream& file) { write_schedule_file(made.sunlit, file); });
      add_sunlit_schedules(*editor, made.sunlit, fractions);
    }
  }
  ScheduledModel done;
  done.path = place_model(*editor, call.model, folder);
  done.warnings = std::move(out.warnings);
  done.remarks = std::move(out.remarks);
  return done;
}

int run_scheduled(Path const& library, RunSetup const& setup) {
  auto const& line = setup.line;
  if (line.preprocessed) {
    throw Error(
        "-m: sunlit fractions of an EPMacro model cannot be passed as schedules; create its IDF "
        "first");
  }
  if (!line.model || !std::filesystem::exists(*line.model)) {
    return run_hosted(library, setup.arguments, {});
  }
  TemporaryFolder const folder;
  auto const prepared = prepare_scheduled(setup.call(own_folder() / "energyplus"), setup.choices,
                                          folder.path(), print_line);
  return run_hosted(library, setup.arguments_for(prepared.path),
                    {prepared.warnings, prepared.remarks});
}

}  // namespace gpu_shading::energyplus
