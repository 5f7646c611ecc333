#include "routes/opengl/queries/drawn_model.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "gpu_shading/error.h"
#include "routes/opengl/queries/named_surfaces.h"
#include "scene/sky_grid.h"
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
  constexpr double rounding = 3e-6;
  SunDirection const patch{std::round(sun.azimuth / sky_step) * sky_step,
                           (std::floor(sun.altitude / sky_step) + 0.5) * sky_step};
  bool const same = glm::distance(to_vector(patch), to_vector(sun)) < rounding;
  return same && is_sky_patch(patch) ? patch : sun;
}

// EnergyPlus never draws the copies of shading surfaces that face the other way.
void warn_of_mirrored(Session const& session, Messages const& messages) {
  if (!session.wants_mirrored() || session.shading_surfaces().empty()) return;
  messages.warning(
      "EnergyPlus does not draw mirrored shading surfaces: their sunlit fraction is reported as 0, "
      "and solar radiation that the back of a shading surface reflects is lost");
}

}  // namespace

DrawnModel::DrawnModel(Input input) : input_(std::move(input)) {
  auto& schedules = input_->simulation.schedules;
  if (!schedules.range) schedules = {unknown_range, unknown_schedule};
}

void DrawnModel::set_model(std::span<glm::vec3 const> vertices,
                           std::span<DrawnRange const> surfaces) {
  sun_.reset();
  if (input_) {
    if (calculation_) throw Error("EnergyPlus draws surfaces that it has not drawn before");
    add_named(vertices, surfaces);
  } else {
    add_outlines(vertices, surfaces);
  }
}

void DrawnModel::add_named(std::span<glm::vec3 const> vertices,
                           std::span<DrawnRange const> surfaces) {
  auto session = std::make_unique<Session>(input_->model);
  for (auto& surface : name_surfaces(vertices, surfaces, input_->named)) {
    parts_.push_back({session->add(std::move(surface))});
  }
  warn_of_mirrored(*session, input_->simulation.messages);
  begin(*session, input_->simulation, input_->task.get());
  calculation_ = std::move(session);
}

void DrawnModel::add_outlines(std::span<glm::vec3 const> vertices,
                              std::span<DrawnRange const> surfaces) {
  calculation_ = make_();
  parts_.clear();
  for (auto const& range : surfaces) {
    auto& parts = parts_.emplace_back();
    for (auto& polygon : polygons_of(vertices.subspan(range.first, range.count))) {
      parts.push_back(calculation_->add({.name = {}, .polygon = std::move(polygon)}));
    }
  }
  calculation_->start({});
}

// EnergyPlus looks at the sky once for all times, or at each time after the sun.
void DrawnModel::set_time(SunDirection sun) {
  if (!input_->time_of) return;
  if (is_sky_patch(sun)) {
    if (!input_->model.shading.detailed_sky) calculation_->set_time({});
  } else if (auto const moment = input_->time_of(to_vector(sun))) {
    calculation_->set_time(*moment);
  }
}

void DrawnModel::set_sun(glm::dvec3 const& towards_sun) {
  if (towards_sun == sun_) return;
  sun_ = towards_sun;
  auto const sun = without_rounding(to_direction(towards_sun));
  if (input_) set_time(sun);
  calculation_->set_sun(sun);
}

double DrawnModel::sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface) {
  set_sun(towards_sun);
  double sum = 0.0;
  for (double const area : calculation_->projected_sunlit_areas(parts_[surface])) sum += area;
  return static_cast<float>(sum);
}

std::vector<double> DrawnModel::interior_areas(glm::dvec3 const& towards_sun, std::size_t window,
                                               std::vector<std::size_t> const& interiors) {
  set_sun(towards_sun);
  std::vector<SurfaceId> ids;
  for (auto const interior : interiors) {
    ids.insert(ids.end(), parts_[interior].begin(), parts_[interior].end());
  }
  std::vector<double> areas(interiors.size(), 0.0);
  for (auto const part : parts_[window]) {
    auto const lit = calculation_->interior_areas(part, ids);
    auto next = lit.begin();
    for (std::size_t i = 0; i < interiors.size(); ++i) {
      for (std::size_t k = 0; k < parts_[interiors[i]].size(); ++k) areas[i] += *next++;
    }
  }
  keep_largest(areas);
  return areas;
}

void DrawnModel::fail(std::string const& why) {
  if (input_ && input_->task) input_->task->fail(why);
  if (calculation_) calculation_->fail();
}

void DrawnModel::finish() {
  if (calculation_) calculation_->finish();
}

}  // namespace gpu_shading::energyplus
