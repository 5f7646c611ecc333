#include "routes/schedules/rendered_fractions.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <utility>

#include "platform/progress.h"
#include "runs/drawing.h"

namespace gpu_shading::energyplus {
namespace {

struct Receiver {
  SurfaceId id;
  glm::dvec3 area;  // times the unit normal
};

// A run's schedules at the time `now`; 0 for schedules that EnergyPlus does not know.
Schedules schedules_of(RunTimes const& run, std::shared_ptr<RunTime const*> const& now) {
  return {
      [&run](std::string const& name) {
        std::pair range(1.0, 0.0);
        for (auto const& time : run.times) {
          double const value = schedule_value(run, time, name);
          range.first = std::min(range.first, value);
          range.second = std::max(range.second, value);
        }
        return range;
      },
      [&run, now](std::string const& name, Moment) { return schedule_value(run, **now, name); }};
}

float fraction(Session& session, Receiver const& receiver, glm::dvec3 const& sun) {
  if (glm::dot(receiver.area, sun) <= 0.0) return 0.0F;
  return static_cast<float>(
      sunlit_fraction(session.projected_sunlit_area(receiver.id), receiver.area, sun));
}

}  // namespace

SunlitFractions render_fractions(Model model, std::vector<Surface> const& surfaces,
                                 RunTimes const& run, Messages const& messages,
                                 std::function<double()> const& latitude) {
  auto const now = std::make_shared<RunTime const*>(nullptr);
  SunlitFractions table;
  table.steps_per_hour = run.steps_per_hour;
  model.options.update.every_timestep = true;
  Session session(std::move(model));
  std::vector<Receiver> receivers;
  for (auto const& surface : surfaces) {
    auto const id = session.add(surface);
    if (!is_exterior(surface.name, session.input())) continue;
    receivers.push_back({id, area(surface.polygon) * normal(surface.polygon)});
    table.surfaces.push_back(surface.name);
  }
  session.start({messages, schedules_of(run, now), latitude});
  Progress progress("rendering sunlit fractions", run.times.size());
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    auto const& time = run.times[i];
    auto const sun = to_vector(time.sun);
    if (!sun_is_up(time.sun)) continue;
    *now = &time;
    session.set_time({time.hour, time.timestep});
    session.set_sun(time.sun);
    auto& row = table.fractions.emplace_back();
    row.reserve(receivers.size());
    for (auto const& receiver : receivers) row.push_back(fraction(session, receiver, sun));
    table.times.push_back(time);
    progress.at(i + 1);
  }
  session.finish();
  return table;
}

std::vector<std::string> unknown_schedules(Model const& model,
                                           std::vector<std::string> const& known) {
  std::vector<std::string> names;
  for (auto const& name : shade_schedules(model)) {
    if (model.shading.actuated.contains(name) ||
        std::find(known.begin(), known.end(), name) == known.end()) {
      names.push_back(name);
    }
  }
  return names;
}

std::string describe_unknown(std::vector<std::string> const& schedules) {
  return fmt::format(
      "Transmittance or Deployment Schedule {}: its values are set by an EMS actuator or another "
      "program and not known in advance; the schedule's own values are used, if it has any",
      fmt::join(schedules, ", "));
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
  names.erase("");
  return {names.begin(), names.end()};
}

}  // namespace gpu_shading::energyplus
