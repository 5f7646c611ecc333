#include "routes/opengl/queries/session_answers.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "answers/foreseen_directions.h"
#include "gpu_shading/error.h"
#include "routes/opengl/queries/named_surfaces.h"
#include "tasks/perform_task.h"

namespace gpu_shading::energyplus {
namespace {

[[noreturn]] double unknown_schedule(std::string const& name, Moment /*moment*/) {
  throw Error("schedule " + name + ": schedules are not known here");
}

[[noreturn]] std::pair<double, double> unknown_range(std::string const& name) {
  unknown_schedule(name, {});
}

// A patch of the sky where the direction is one, rounded to single precision.
SunDirection without_rounding(SunDirection sun) {
  constexpr double step = std::numbers::pi / 12.0;
  constexpr double rounding = 3e-6;
  SunDirection const patch{std::round(sun.azimuth / step) * step,
                           (std::floor(sun.altitude / step) + 0.5) * step};
  bool const same = glm::distance(to_vector(patch), to_vector(sun)) < rounding;
  return same && is_sky_patch(patch) ? patch : sun;
}

}  // namespace

SessionAnswers::SessionAnswers(Input input) : input_(std::move(input)), session_(input_.model) {
  if (!input_.schedules.range) input_.schedules = {unknown_range, unknown_schedule};
}

void SessionAnswers::set_model(std::span<glm::vec3 const> vertices,
                               std::span<DrawnRange const> surfaces) {
  if (session_.size() > 0) throw Error("EnergyPlus draws surfaces that it has not drawn before");
  for (auto& surface : name_surfaces(vertices, surfaces, input_.named)) {
    session_.add(std::move(surface));
  }
  warn_of_mirrored();
  if (input_.task) {
    auto& scene = session_.complete(input_.schedules);
    input_.task->finish(perform_task(input_.task->task(), scene, input_.messages));
    throw TaskDone();
  }
  session_.start(input_.messages, input_.schedules, input_.latitude);
}

// The copies of shading surfaces that face the other way are never drawn.
void SessionAnswers::warn_of_mirrored() const {
  auto const& input = session_.input();
  if (!(input.reflections || input.mirrored_shown()) || session_.shading_surfaces().empty()) return;
  input_.messages.warning(
      "EnergyPlus does not draw mirrored shading surfaces: their sunlit fraction is reported as 0, "
      "and solar radiation that the back of a shading surface reflects is lost");
}

// EnergyPlus looks at the sky once for all times, or at each time after the sun.
void SessionAnswers::set_time(SunDirection sun) {
  if (!input_.time_of) return;
  if (is_sky_patch(sun)) {
    if (!input_.model.shading.detailed_sky) session_.set_time({});
  } else if (auto const moment = input_.time_of(to_vector(sun))) {
    session_.set_time(*moment);
  }
}

void SessionAnswers::set_sun(glm::dvec3 const& towards_sun) {
  if (towards_sun == sun_) return;
  sun_ = towards_sun;
  auto const sun = without_rounding(to_direction(towards_sun));
  set_time(sun);
  session_.set_sun(sun);
}

double SessionAnswers::sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface) {
  set_sun(towards_sun);
  return session_.projected_sunlit_area(static_cast<SurfaceId>(surface));
}

std::vector<double> SessionAnswers::interior_areas(glm::dvec3 const& towards_sun,
                                                   std::size_t window,
                                                   std::vector<std::size_t> const& interiors) {
  set_sun(towards_sun);
  std::vector<SurfaceId> const ids(interiors.begin(), interiors.end());
  auto const areas = session_.interior_areas(static_cast<SurfaceId>(window), ids);
  return {areas.begin(), areas.end()};
}

void SessionAnswers::fail(std::string const& why) {
  if (input_.task) input_.task->fail(why);
}

void SessionAnswers::finish() { session_.finish(); }

}  // namespace gpu_shading::energyplus
