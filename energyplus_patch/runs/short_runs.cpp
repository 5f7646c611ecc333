#include "runs/short_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "gpu_shading/error.h"
#include "model/idf/input_object.h"
#include "model/idf/model_editor.h"
#include "model/idf/model_file.h"
#include "model/idf/placeholders.h"
#include "platform/files.h"
#include "platform/process.h"
#include "platform/text.h"
#include "runs/named_files.h"
#include "runs/refused_run.h"

namespace gpu_shading::energyplus {
namespace {

using Path = std::filesystem::path;

bool starts(std::string_view type, std::string_view prefix) {
  return type.size() >= prefix.size() && same_name(type.substr(0, prefix.size()), prefix);
}

enum class Periods { run, sizing, all };

// Without sizing.
std::vector<NewField> simulation_control(Periods periods) {
  auto const yes_if = [](bool wanted) { return wanted ? "Yes" : "No"; };
  return {{"do_zone_sizing_calculation", "No"},
          {"do_system_sizing_calculation", "No"},
          {"do_plant_sizing_calculation", "No"},
          {"run_simulation_for_sizing_periods", yes_if(periods != Periods::run)},
          {"run_simulation_for_weather_file_run_periods", yes_if(periods != Periods::sizing)}};
}

void shorten_run_periods(ModelEditor& model) {
  constexpr std::pair<FieldPosition, FieldPosition> month{{1, "begin_month"}, {4, "end_month"}};
  constexpr std::pair<FieldPosition, FieldPosition> day{{2, "begin_day_of_month"},
                                                        {5, "end_day_of_month"}};
  constexpr std::pair<FieldPosition, FieldPosition> year{{3, "begin_year"}, {6, "end_year"}};
  model.edit("RunPeriod", [&](EditedObject& period) {
    for (auto const& [begin, end] : {month, day, year}) {
      auto const value = parse_number(period.get(begin));
      if (value) period.set(end, static_cast<int>(*value));
    }
  });
}

enum class Control {
  of_run_periods,  // one day, without sizing
  of_model,
};

// Reduces a model to what a drawing of the surfaces needs.
void reduce_to_surfaces(ModelEditor& model, Control control) {
  bool const own = control == Control::of_model;
  model.remove([&](std::string_view type) {
    return is_extension(type) || starts(type, "Output") || starts(type, "SurfaceProperty") ||
           same_name(type, "ShadowCalculation") || (!own && same_name(type, "SimulationControl"));
  });
  if (!own) model.add({"SimulationControl", simulation_control(Periods::run)});
  shorten_run_periods(model);
  model.edit("Building", [](EditedObject& building) {
    building.set({5, "solar_distribution"}, "MinimalShadowing");
  });
  model.add({"Output:Surfaces:Drawing", {{"report_type", "DXF:WireFrame"}}});
}

void report_at_timesteps(ModelEditor& model, std::string const& key, std::string_view variable) {
  model.add(
      {"Output:Variable",
       {{"key_value", key}, {"variable_name", variable}, {"reporting_frequency", "Timestep"}}});
}

// Adds a schedule of ours unless the model has been rewritten with it.
void add_own_schedule(ModelEditor& model, std::string const& name) {
  if (model.has("Schedule:Compact", name)) return;
  for (auto const& object : schedule_objects(name)) model.add(object);
}

// Reduces the model of a file to its calendar, site and schedules.
void reduce_to_times(ModelEditor& model, std::vector<std::string> const& schedules,
                     Periods periods = Periods::run) {
  model.remove([&](std::string_view type) {
    bool const kept = same_name(type, "Version") || same_name(type, "Timestep") ||
                      same_name(type, "Site:Location") ||
                      same_name(type, "Site:VariableLocation") || starts(type, "RunPeriod") ||
                      starts(type, "Site:GroundReflectance") || starts(type, "Schedule") ||
                      (periods != Periods::run && starts(type, "SizingPeriod"));
    return !kept || same_name(type, "Schedule:File:Shading");
  });
  model.add({"SimulationControl", simulation_control(periods)});
  model.add({"Building", {{"name", "Sun"}, {"north_axis", 0}}});
  model.add({"GlobalGeometryRules",
             {{"starting_vertex_position", "UpperLeftCorner"},
              {"vertex_entry_direction", "Counterclockwise"},
              {"coordinate_system", "World"}}});
  report_at_timesteps(model, "*", "Site Solar Azimuth Angle");
  report_at_timesteps(model, "*", "Site Solar Altitude Angle");
  for (auto const& schedule : schedules) {
    if (is_own_schedule(schedule)) add_own_schedule(model, schedule);
    report_at_timesteps(model, schedule, "Schedule Value");
  }
}

void report_weather(ModelEditor& model) {
  for (auto const& [variable, member] : weather_variables) {
    report_at_timesteps(model, "*", variable);
  }
}

bool has_sizing_periods(ModelEditor& model) {
  bool found = false;
  for (char const* const type : {"SizingPeriod:DesignDay", "SizingPeriod:WeatherFileDays",
                                 "SizingPeriod:WeatherFileConditionType"}) {
    model.edit(type, [&](EditedObject const&) { found = true; });
  }
  return found;
}

// Adds the times of the year that a run lacks. Both have the same schedules and timesteps.
void add_missing(RunTimes& run, RunTimes const& more) {
  auto const row = [&](RunTime const& time) { return row_of(time, run.steps_per_hour); };
  std::vector<RunTime> all;
  std::ranges::set_union(run.times, more.times, std::back_inserter(all), {}, row, row);
  run.times = std::move(all);
}

// Replaces all run periods by one that EnergyPlus extends to a year (-a): the first, which sets the
// year or the day of the week.
void keep_one_run_period(ModelEditor& model) {
  constexpr std::array<FieldPosition, 10> fields{{{1, "begin_month"},
                                                  {2, "begin_day_of_month"},
                                                  {3, "begin_year"},
                                                  {4, "end_month"},
                                                  {5, "end_day_of_month"},
                                                  {6, "end_year"},
                                                  {7, "day_of_week_for_start_day"},
                                                  {8, "use_weather_file_holidays_and_special_days"},
                                                  {9, "use_weather_file_daylight_saving_period"},
                                                  {10, "apply_weekend_holiday_rule"}}};
  std::vector<NewField> period{{"name", "Year"}};
  model.edit("RunPeriod", [&](EditedObject const& first) {
    if (period.size() > 1) return;
    for (auto const& field : fields) {
      auto const text = first.get(field);
      auto const number = parse_number(text);
      period.push_back(
          {field.name, number ? nlohmann::json(std::lround(*number)) : nlohmann::json(text)});
    }
  });
  if (period.size() == 1) {
    constexpr int december = 12;
    constexpr int last = 31;
    for (int const value : {1, 1, 0, december, last}) {
      auto const name = fields.at(period.size() - 1).name;
      period.push_back({name, value == 0 ? nlohmann::json("") : nlohmann::json(value)});
    }
  }
  model.remove([](std::string_view type) { return same_name(type, "RunPeriod"); });
  model.add({"RunPeriod", period});
}

// Runs a reduced model and returns the requested output.
std::ifstream run(EnergyPlusCall const& call, ModelEditor& model, bool expand,
                  TemporaryFolder const& folder, std::string_view output) {
  auto const out = folder.path() / "out";
  std::filesystem::create_directory(out);
  auto const path = place_model(model, call.model, folder.path() / "in");
  std::vector<std::string> command{call.program.string(), "-d", out.string()};
  if (call.weather)
    command.insert(command.end(), {"-w", std::filesystem::absolute(*call.weather).string()});
  if (expand) command.emplace_back("-x");
  if (call.annual) command.emplace_back("-a");
  if (call.design_days) command.emplace_back("-D");
  command.push_back(path.string());
  auto const log = folder.path() / "log.txt";
  // An empty variable counts as unset, so EnergyPlus runs unmodified.
  // ExpandObjects deletes an expanded.idf of the user where it starts.
  auto const start = expand ? folder.path() : Path();
  int const status = run_process(command, {"GPU_SHADING="}, log, start);
  // EnergyPlus itself does not notice a full disk.
  require_room(folder.path());
  std::ifstream file(out / output);
  if (!file || status != 0) {
    if (auto const error = last_error(log)) throw Error(*error);
    throw Error(fmt::format("{}: EnergyPlus stopped before its shading calculation ({}): {}",
                            call.model.string(), describe_status(status), stop_reasons(out)));
  }
  return file;
}

// The times of a reduced model.
RunTimes run_whole_year(EnergyPlusCall const& call, ModelEditor& model) {
  keep_one_run_period(model);
  TemporaryFolder const folder;
  auto year = call;
  year.annual = true;
  year.design_days = false;
  auto file = run(year, model, false, folder, "eplusout.eso");
  auto times = read_run_times(file);
  std::ifstream eio(folder.path() / "out" / "eplusout.eio");
  times.year = read_first_year(eio);
  return times;
}

std::vector<DrawnSurface> draw(EnergyPlusCall const& call, Control control) {
  auto const model = edit_model(call.model);
  reduce_to_surfaces(*model, control);
  TemporaryFolder const folder;
  auto day = call;
  day.annual = false;
  day.design_days = call.design_days && control == Control::of_model;
  auto file = run(day, *model, call.expand, folder, "eplusout.dxf");
  return read_drawing(file);
}

}  // namespace

std::vector<DrawnSurface> run_for_surfaces(EnergyPlusCall const& call) {
  try {
    return draw(call, Control::of_run_periods);
  } catch (Interrupted const&) {
    throw;
  } catch (Error const&) {
    // Without run periods, or with equipment that has to be sized.
    return draw(call, Control::of_model);
  }
}

bool runs_periods(EnergyPlusCall const& call, ModelEditor& model) {
  if (call.annual || call.design_days) return call.annual;
  bool any = false;
  bool wanted = true;
  model.edit("RunPeriod", [&](EditedObject const&) { any = true; });
  model.edit("SimulationControl", [&](EditedObject const& control) {
    wanted = !same_name(control.get({4, "run_simulation_for_weather_file_run_periods"}), "No");
  });
  return any && wanted;
}

RunTimes run_for_times(EnergyPlusCall const& call, std::vector<std::string> const& schedules,
                       Dates dates) {
  auto const times_of = [&](Periods periods) {
    auto const model = edit_model(call.model);
    reduce_to_times(*model, schedules, periods);
    report_weather(*model);
    TemporaryFolder const folder;
    auto part = call;
    part.design_days = false;
    part.annual = call.annual && periods == Periods::run;
    auto file = run(part, *model, false, folder, "eplusout.eso");
    return read_run_times(file, periods == Periods::run ? Repeated::alike : Repeated::first);
  };
  auto const whole = edit_model(call.model);
  RunTimes times;
  if (runs_periods(call, *whole)) times = times_of(Periods::run);
  constexpr std::size_t hours_of_year = 8760;
  auto const steps = static_cast<std::size_t>(times.steps_per_hour);
  bool const whole_year = steps > 0 && times.times.size() >= hours_of_year * steps;
  if (dates == Dates::of_run_periods || whole_year || !has_sizing_periods(*whole)) return times;
  if (times.times.empty()) return times_of(Periods::sizing);
  add_missing(times, times_of(Periods::sizing));
  return times;
}

RunTimes run_for_year(EnergyPlusCall const& call, std::vector<std::string> const& schedules,
                      int steps_per_hour) {
  auto const model = edit_model(call.model);
  reduce_to_times(*model, schedules);
  model->remove([](std::string_view type) { return same_name(type, "Timestep"); });
  model->add({"Timestep", {{"number_of_timesteps_per_hour", steps_per_hour}}});
  return run_whole_year(call, *model);
}

RunTimes run_for_beam(EnergyPlusCall const& call, std::vector<std::string> const& schedules) {
  auto const model = edit_model(call.model);
  reduce_to_times(*model, schedules);
  report_weather(*model);
  return run_whole_year(call, *model);
}

ScheduleDays run_for_schedules(EnergyPlusCall const& call,
                               std::vector<std::string> const& schedules) {
  auto const model = edit_model(call.model);
  bool const sizing = has_sizing_periods(*model);
  reduce_to_times(*model, schedules,
                  call.design_days ? Periods::sizing
                  : sizing         ? Periods::all
                                   : Periods::run);
  TemporaryFolder const folder;
  auto file = run(call, *model, false, folder, "eplusout.eso");
  return read_schedule_days(file);
}

Path place_model(ModelEditor& model, Path const& original, Path const& folder) {
  std::filesystem::create_directories(folder);
  auto const source = std::filesystem::weakly_canonical(original);
  bring_named_files(model, source, folder);
  auto path = folder / source.filename();
  write_whole_file(path, [&](std::ostream& file) { file << model.text(); });
  return path;
}

}  // namespace gpu_shading::energyplus
