#include "gl_boundary/session_answers.h"

#include <utility>

#include "gl_boundary/named_surfaces.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

[[noreturn]] double unknown_schedule(std::string const& name, Moment /*moment*/) {
  throw Error("schedule " + name + ": schedules are not known here");
}

[[noreturn]] std::pair<double, double> unknown_range(std::string const& name) {
  unknown_schedule(name, {});
}

}  // namespace

SessionAnswers::SessionAnswers(Input input) : input_(std::move(input)), session_(input_.model) {}

void SessionAnswers::set_model(std::span<glm::vec3 const> vertices,
                               std::span<DrawnRange const> surfaces) {
  if (session_.size() > 0) throw Error("EnergyPlus draws surfaces that it has not drawn before");
  for (auto& surface : name_surfaces(vertices, surfaces, input_.named)) {
    session_.add(std::move(surface));
  }
  session_.start(input_.messages, {unknown_range, unknown_schedule}, input_.latitude);
}

void SessionAnswers::set_sun(glm::dvec3 const& towards_sun) {
  if (towards_sun == sun_) return;
  sun_ = towards_sun;
  session_.set_sun(to_direction(towards_sun));
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

void SessionAnswers::finish() { session_.finish(); }

}  // namespace gpu_shading::energyplus
