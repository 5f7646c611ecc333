#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "gpu_shading/sun_direction.h"
#include "gpu_shading/transport.h"

namespace gpu_shading {
namespace {

constexpr double solstice = glm::radians(23.46);
constexpr double lowest = glm::radians(0.5);  // altitude of a sun of the table

}  // namespace

SunTable::SunTable(double latitude, int declinations, double step)
    : hour_step_(step),
      declination_step_(2.0 * solstice / (declinations - 1)),
      declinations_(declinations) {
  double const longest = sunset_hour_angle(latitude < 0.0 ? -solstice : solstice, latitude);
  int const each_way =
      static_cast<int>(std::ceil(std::min(std::numbers::pi, longest + glm::radians(0.1)) / step));
  first_hour_ = -each_way * step;
  hours_ = 2 * each_way + 1;
  // A cell reaches below the horizon by less than this.
  double const margin = 0.8 * std::max(step, declination_step_);
  for (int i = 0; i < declinations_; ++i) {
    for (int j = 0; j < hours_; ++j) {
      HourDirection const at{-solstice + i * declination_step_, first_hour_ + j * step};
      auto vector = to_vector(to_direction(at, latitude));
      if (vector.z < -std::sin(margin)) {
        index_.push_back(-1);
        continue;
      }
      vector.z = std::max(vector.z, std::sin(lowest));
      index_.push_back(static_cast<int>(suns_.size()));
      suns_.push_back(glm::normalize(vector));
    }
  }
}

std::array<SunTable::Corner, 4> SunTable::around(HourDirection sun) const {
  struct Cell {
    int from;
    double share;
  };
  auto const cell = [](double place, int count) {
    double const inside = std::clamp(place, 0.0, count - 1.0);
    int const from = std::min(static_cast<int>(inside), count - 2);
    return Cell{from, inside - from};
  };
  auto const corner = [&](int i, int j, double share) {
    int const index = index_[static_cast<std::size_t>(i) * static_cast<std::size_t>(hours_) +
                             static_cast<std::size_t>(j)];
    return index < 0 ? Corner{} : Corner{static_cast<std::size_t>(index), share};
  };
  auto const [i, a] = cell((sun.declination + solstice) / declination_step_, declinations_);
  auto const [j, b] = cell((sun.hour_angle - first_hour_) / hour_step_, hours_);
  return {corner(i, j, (1.0 - a) * (1.0 - b)), corner(i, j + 1, (1.0 - a) * b),
          corner(i + 1, j, a * (1.0 - b)), corner(i + 1, j + 1, a * b)};
}

double SunTable::at(std::span<double const> values, HourDirection sun) const {
  double sum = 0.0;
  for (auto const& corner : around(sun)) sum += corner.share * values[corner.sun];
  return sum;
}

LightByGround Transported::beam_at(HourDirection sun) const {
  LightByGround light;
  for (auto const& corner : table.around(sun)) light += corner.share * beam[corner.sun];
  return light;
}

}  // namespace gpu_shading
