#include "routes/penumbra/library/model_calculation.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/console.h"
#include "routes/penumbra/library/surface_of.h"

namespace gpu_shading::energyplus {
namespace {

double limited(double value) { return std::clamp(value, 0.0, 1.0); }

glm::dvec3 to_glm(std::array<double, 3> const& vector) { return {vector[0], vector[1], vector[2]}; }

}  // namespace

ModelCalculation::ModelCalculation(Model model, answers::Log log)
    : log_(std::move(log)),
      rays_answered_(model.daylighting_answered),
      session_(std::move(model)) {}

unsigned ModelCalculation::add(answers::PlainSurface surface) {
  return session_.add(surface_of(std::move(surface)));
}

int ModelCalculation::add_mirrored(unsigned original) {
  auto const& input = session_.input();
  if (!input.reflections && !input.mirrored_shown()) return -1;
  if (original >= session_.size()) throw Error("a mirrored surface comes before its original");
  return static_cast<int>(session_.add_mirrored(original));
}

Messages ModelCalculation::messages() const {
  return {[this](std::string const& line) {
            print_line("warning: " + line);
            log_.warning(line);
          },
          [this](std::string const& line) {
            print_line(line);
            log_.info(line);
          },
          [this](std::string const& text) {
            if (simulation_.initialization) simulation_.initialization(text);
          }};
}

int ModelCalculation::schedule_number(std::string const& name) const {
  auto const [place, added] = schedule_numbers_.try_emplace(name, 0);
  if (added && simulation_.schedule) place->second = simulation_.schedule(name);
  if (place->second == 0) throw Error(fmt::format("EnergyPlus has no schedule \"{}\"", name));
  return place->second;
}

Schedules ModelCalculation::schedules() const {
  auto const range = [this](std::string const& name) {
    auto const [least, most] = simulation_.schedule_range(schedule_number(name));
    return std::pair(limited(least), limited(most));
  };
  return {range, [this, range](std::string const& name, Moment moment) {
            if (moment.timestep <= 0) return range(name).first;
            return limited(
                simulation_.schedule_value(schedule_number(name), moment.hour, moment.timestep));
          }};
}

void ModelCalculation::start(answers::Simulation simulation) {
  if (started_) throw Error("the surfaces of a model can be set once");
  started_ = true;
  simulation_ = std::move(simulation);
  session_.start(messages(), schedules(), simulation_.latitude);
}

void ModelCalculation::set_time(int hour, int timestep) {
  session_.set_time(timestep > 0 ? Moment{hour, timestep} : Moment{});
}

void ModelCalculation::set_sun(double azimuth, double altitude) {
  session_.set_sun({azimuth, altitude});
}

float ModelCalculation::sunlit_area(unsigned surface) {
  return session_.projected_sunlit_area(surface);
}

std::vector<float> ModelCalculation::sunlit_areas(std::vector<unsigned> const& surfaces) {
  std::vector<float> areas;
  areas.reserve(surfaces.size());
  for (auto const surface : surfaces) areas.push_back(sunlit_area(surface));
  return areas;
}

std::vector<float> ModelCalculation::interior_areas(unsigned window,
                                                    std::vector<unsigned> const& interiors) {
  return session_.interior_areas(window, interiors);
}

double ModelCalculation::ray_transmittance(answers::DaylightRay const& ray) {
  constexpr double opaque_below = 1e-6;  // as EnergyPlus's shading surfaces are
  if (!rays_answered_) return 1.0;
  double const share =
      session_.daylight_transmittance({to_glm(ray.origin), to_glm(ray.direction)}, ray.hour);
  return share < opaque_below ? 0.0 : share;
}

void ModelCalculation::begin_daylighting() { session_.begin_daylighting(); }

std::string ModelCalculation::vendor() { return {}; }

void ModelCalculation::finish() { session_.finish(); }

}  // namespace gpu_shading::energyplus
