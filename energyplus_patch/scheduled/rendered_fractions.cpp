#include "scheduled/rendered_fractions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <utility>

#include "scheduled/drawn_surfaces.h"
#include "scheduled/progress.h"

namespace gpu_shading::energyplus {
namespace {

// EnergyPlus's own limit (Engineering Reference, "Shading Module"): the sun is down below it, and
// behind a surface of a smaller cosine of incidence.
constexpr double sun_is_up = 1e-5;

struct Receiver {
  SurfaceId id;
  glm::dvec3 normal;
  double area;
};

// A run's schedules at the time of `now`; 0 for those that EnergyPlus does not know.
Schedules schedules_of(RunTimes const& run, std::shared_ptr<RunTime const*> const& now) {
  auto const place = [&run](std::string const& name) {
    auto const found = std::find(run.schedules.begin(), run.schedules.end(), name);
    return static_cast<std::size_t>(found - run.schedules.begin());
  };
  auto const at = [](RunTime const& time, std::size_t i) {
    return i < time.schedules.size() ? std::clamp(time.schedules[i], 0.0, 1.0) : 0.0;
  };
  return {[=, &run](std::string const& name) {
            auto const i = place(name);
            std::pair range(1.0, 0.0);
            for (auto const& time : run.times) {
              range.first = std::min(range.first, at(time, i));
              range.second = std::max(range.second, at(time, i));
            }
            return range;
          },
          [=](std::string const& name, Moment) { return at(**now, place(name)); }};
}

float fraction(Session& session, Receiver const& receiver, glm::dvec3 const& sun) {
  double const cosine = glm::dot(receiver.normal, sun);
  if (cosine < sun_is_up || receiver.area <= 0.0) return 0.0F;
  double const lit = session.projected_sunlit_area(receiver.id);
  return static_cast<float>(std::clamp(lit / (cosine * receiver.area), 0.0, 1.0));
}

}  // namespace

SunlitTable render_fractions(Model model, std::vector<Surface> const& surfaces, RunTimes const& run,
                             Session::Messages const& messages) {
  auto const now = std::make_shared<RunTime const*>(nullptr);
  SunlitTable table;
  table.steps_per_hour = run.steps_per_hour;
  model.options.update = {true};
  Session session(std::move(model));
  std::vector<Receiver> receivers;
  for (auto const& surface : surfaces) {
    auto const id = session.add(surface);
    if (!is_exterior(surface.name, session.input())) continue;
    receivers.push_back({id, normal(surface.polygon), area(surface.polygon)});
    table.surfaces.push_back(surface.name);
  }
  session.start(messages, schedules_of(run, now));
  Progress progress("rendering sunlit fractions", run.times.size());
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    auto const& time = run.times[i];
    auto const sun = to_vector(time.sun);
    if (sun.z < sun_is_up) continue;
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

std::vector<std::string> shade_schedules(Model const& model) {
  std::set<std::string> names;
  for (auto const& [name, surface] : model.shading.shading_surfaces) {
    names.insert(surface.transmittance_schedule);
  }
  for (auto const& [name, screen] : model.screens.by_surface) {
    names.insert(screen.deployment_schedule);
  }
  names.erase("");
  return {names.begin(), names.end()};
}

}  // namespace gpu_shading::energyplus
