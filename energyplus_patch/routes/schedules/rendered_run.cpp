#include "routes/schedules/rendered_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <ostream>
#include <set>
#include <utility>

#include "model/idf/model_editor.h"
#include "model/reflected_light_input.h"
#include "platform/files.h"
#include "platform/progress.h"
#include "runs/drawing.h"
#include "scene/run_schedules.h"

namespace gpu_shading::energyplus {
namespace {

struct Receiver {
  SurfaceId id;
  glm::dvec3 area;  // times the unit normal
};

float fraction(Session& session, Receiver const& receiver, glm::dvec3 const& sun) {
  if (glm::dot(receiver.area, sun) <= 0.0) return 0.0F;
  return static_cast<float>(
      sunlit_fraction(session.projected_sunlit_area(receiver.id), receiver.area, sun));
}

// The session of a run that is computed before EnergyPlus begins it.
class TimedSession {
 public:
  TimedSession(Model model, std::vector<Surface> const& surfaces, RunTimes const& run,
               Messages const& messages, std::function<double()> const& latitude)
      : session_(std::move(model)) {
    for (auto const& surface : surfaces) {
      auto const id = session_.add(surface);
      if (!is_exterior(surface.name, session_.input())) continue;
      receivers_.push_back({id, area(surface.polygon) * normal(surface.polygon)});
      names_.push_back(surface.name);
    }
    auto schedules = schedules_of(run, now_);
    schedules.position = nullptr;  // shades do not move by this method
    session_.start({messages, std::move(schedules), latitude});
  }

  std::vector<std::string> const& names() const { return names_; }

  void set_time(RunTime const& time) {
    *now_ = &time;
    session_.set_time({time.hour, time.timestep});
    session_.set_sun(time.sun);
  }

  std::vector<float> fractions(RunTime const& time) {
    std::vector<float> row;
    row.reserve(receivers_.size());
    for (auto const& receiver : receivers_) {
      row.push_back(fraction(session_, receiver, to_vector(time.sun)));
    }
    return row;
  }

  std::vector<float> grounds(RunTime const& time) {
    SkyWeather const weather{to_vector(time.sun), time.beam, time.diffuse};
    auto const values =
        session_.ground_reflectances({{time.hour, time.timestep},
                                      weather,
                                      weather.ground_reflectance(time.reflected_by_ground)});
    return {values.begin(), values.end()};
  }

  void finish() { session_.finish(); }

 private:
  Session session_;
  std::shared_ptr<RunTime const*> now_ = std::make_shared<RunTime const*>(nullptr);
  std::vector<Receiver> receivers_;
  std::vector<std::string> names_;
};

}  // namespace

RenderedRun render_run(Model model, std::vector<Surface> const& surfaces, RunTimes const& run,
                       Messages const& messages, std::function<double()> const& latitude,
                       Rendered wanted) {
  RenderedRun made;
  made.sunlit.steps_per_hour = made.grounds.steps_per_hour = run.steps_per_hour;
  made.grounds.otherwise = min_ground_reflectance;
  for (auto const& receiver : model.reflected_light.receivers) {
    made.grounds.columns.push_back(receiver.surface);
  }
  model.options.update.every_timestep = true;
  TimedSession session(std::move(model), surfaces, run, messages, latitude);
  if (wanted == Rendered::all) made.sunlit.columns = session.names();
  Progress progress("rendering a run's shading", run.times.size());
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    auto const& time = run.times[i];
    if (!sun_is_up(time.sun)) continue;
    session.set_time(time);
    if (wanted == Rendered::all) {
      made.sunlit.values.push_back(session.fractions(time));
      made.sunlit.times.push_back(time);
    }
    if (auto row = session.grounds(time); !row.empty()) {
      made.grounds.values.push_back(std::move(row));
      made.grounds.times.push_back(time);
    }
    progress.at(i + 1);
  }
  session.finish();
  return made;
}

void add_ground_schedules(ModelEditor& editor, ReflectedLight const& light,
                          ScheduleTable const& grounds, std::filesystem::path const& folder) {
  constexpr char const* file = "gpu_shading_grounds.csv";
  write_whole_file(folder / file, [&](std::ostream& out) { write_schedule_file(grounds, out); });
  if (grounds.empty()) {
    for (auto const& schedule : constant_schedules(light)) editor.add(schedule);
    return;
  }
  for (std::size_t i = 0; i < light.receivers.size(); ++i) {
    editor.add(file_schedule(grounds, i, light.receivers[i].schedule, light.schedule_limits, file));
  }
}

std::optional<std::string> warn_of_actuated(Model const& model) {
  auto names = shade_schedules(model);
  std::erase_if(names, [&](auto const& name) { return !model.shading.actuated.contains(name); });
  if (names.empty()) return std::nullopt;
  return fmt::format(
      "{}: an EMS actuator sets this schedule of a shade, whose values are not known in advance; "
      "the schedule's own values are used",
      fmt::join(names, ", "));
}

std::vector<std::string> shade_schedules(Model const& model) {
  std::set<std::string> names;
  for (auto const& [name, surface] : model.shading.shading_surfaces) {
    names.insert(surface.transmittance_schedule);
  }
  for (auto const& [name, screen] : model.screens.by_surface) {
    names.insert(screen.deployment_schedule);
  }
  names.insert(model.surroundings.leaf_schedules.begin(), model.surroundings.leaf_schedules.end());
  for (auto const& shade : model.moving_shades) {
    names.insert({shade.schedule, shade.availability});
  }
  names.erase("");
  return {names.begin(), names.end()};
}

}  // namespace gpu_shading::energyplus
