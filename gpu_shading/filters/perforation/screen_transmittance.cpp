#include "gpu_shading/screen_transmittance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "filters/perforation/tile_table.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

void check_finite_thickness(double thickness) {
  if (thickness >= 0.0 && std::isfinite(thickness)) return;
  throw Error(fmt::format("thickness is {:.9g} m, expected 0 or more", thickness));
}

// The two of a row's `count` values between which a position lies.
struct Between {
  std::size_t below = 0;
  std::size_t above = 0;
  float part = 0.0F;
};

Between between_directions(double phi, int directions) {
  double const turns = phi / pi;
  double const place = (turns - std::floor(turns)) * directions;
  int const below = static_cast<int>(place);
  return {.below = static_cast<std::size_t>(below % directions),
          .above = static_cast<std::size_t>((below + 1) % directions),
          .part = static_cast<float>(place - below)};
}

Between between_steps(double place, int steps) {
  double const within = std::min(place, static_cast<double>(steps - 1));
  int const below = std::min(static_cast<int>(within), steps - 2);
  return {.below = static_cast<std::size_t>(below),
          .above = static_cast<std::size_t>(below + 1),
          .part = static_cast<float>(within - below)};
}

// The two of a row of regions, which repeats, between whose centres a position lies.
Between between_regions(double place, int regions) {
  double const from_centres = place * regions - 0.5;
  double const below = std::floor(from_centres);
  int const first = static_cast<int>(below) + regions;
  return {.below = static_cast<std::size_t>(first % regions),
          .above = static_cast<std::size_t>((first + 1) % regions),
          .part = static_cast<float>(from_centres - below)};
}

}  // namespace

ScreenTransmittance::ScreenTransmittance(HolePattern const& pattern, double thickness)
    : thickness_(thickness), longest_chord_(pattern.longest_chord()) {
  check_finite_thickness(thickness);
  steps_ = 513;
  step_ = longest_chord_ / (steps_ - 1);
  for (int direction = 0; direction < directions(); ++direction) {
    double const phi = direction * pi / directions();
    for (int i = 0; i < steps_; ++i) {
      values_.push_back(static_cast<float>(
          pattern.transmittance(i * step_ * std::cos(phi), i * step_ * std::sin(phi))));
    }
  }
}

ScreenTransmittance::ScreenTransmittance(OpacityTile const& tile, double thickness)
    : thickness_(thickness) {
  check_finite_thickness(thickness);
  TileTable table = make_tile_table(tile, thickness, directions());
  regions_across_ = table.regions_across;
  regions_up_ = table.regions_up;
  step_ = table.step;
  steps_ = table.steps;
  longest_chord_ = table.longest_chord;
  if (regions() == 1) {
    values_ = std::move(table.values);
    return;
  }
  region_directions_ = table.directions;
  region_values_ = std::move(table.values);
  for (int direction = 0; direction < directions(); ++direction) {
    double const phi = direction * pi / directions();
    for (int step = 0; step < steps_; ++step) {
      std::vector<float> const at_step = of_regions(step, phi);
      values_.push_back(static_cast<float>(std::accumulate(at_step.begin(), at_step.end(), 0.0) /
                                           static_cast<double>(at_step.size())));
    }
  }
}

double ScreenTransmittance::at(double shift, double phi) const {
  if (shift >= longest_chord_) return 0.0;
  Between const step = between_steps(shift / step_, steps_);
  Between const direction = between_directions(phi, directions());
  auto const steps = static_cast<std::size_t>(steps_);
  auto const in_direction = [&](std::size_t row) {
    float const* const values = &values_[row * steps];
    return std::lerp(static_cast<double>(values[step.below]),
                     static_cast<double>(values[step.above]), static_cast<double>(step.part));
  };
  return std::lerp(in_direction(direction.below), in_direction(direction.above),
                   static_cast<double>(direction.part));
}

// The regions' values at the steps and directions about a shift.
struct ScreenTransmittance::Lookup {
  float const* first;
  float const* second;
  float const* third;
  float const* fourth;
  float along_steps;
  float along_directions;

  float operator()(std::size_t region) const {
    float const below = first[region] + along_steps * (second[region] - first[region]);
    float const above = third[region] + along_steps * (fourth[region] - third[region]);
    return below + along_directions * (above - below);
  }
};

ScreenTransmittance::Lookup ScreenTransmittance::lookup(double place, double phi) const {
  Between const step = between_steps(place, steps_);
  Between const direction = between_directions(phi, region_directions_);
  auto const steps = static_cast<std::size_t>(steps_);
  auto const count = static_cast<std::size_t>(regions());
  auto const at = [&](std::size_t in_direction, std::size_t at_step) {
    return &region_values_[(in_direction * steps + at_step) * count];
  };
  return {at(direction.below, step.below),
          at(direction.below, step.above),
          at(direction.above, step.below),
          at(direction.above, step.above),
          step.part,
          direction.part};
}

std::vector<float> ScreenTransmittance::of_regions(double place, double phi) const {
  Lookup const value = lookup(place, phi);
  std::vector<float> values(static_cast<std::size_t>(regions()));
  for (std::size_t region = 0; region < values.size(); ++region) values[region] = value(region);
  return values;
}

double ScreenTransmittance::at_place(double shift, double phi, glm::dvec2 const& place) const {
  if (shift >= longest_chord_) return 0.0;
  if (regions() == 1) return at(shift, phi);
  Lookup const value = lookup(shift / step_, phi);
  Between const across = between_regions(place.x, regions_across_);
  Between const up = between_regions(place.y, regions_up_);
  auto const row = [&](std::size_t number) {
    std::size_t const first = number * static_cast<std::size_t>(regions_across_);
    return std::lerp(value(first + across.below), value(first + across.above), across.part);
  };
  return std::lerp(row(up.below), row(up.above), up.part);
}

std::vector<float> ScreenTransmittance::at_shift(double shift, double phi) const {
  if (regions() == 1) return {static_cast<float>(at(shift, phi))};
  if (shift >= longest_chord_) return std::vector<float>(static_cast<std::size_t>(regions()), 0.0F);
  return of_regions(shift / step_, phi);
}

double ScreenTransmittance::operator()(double theta, double phi) const {
  if (thickness_ == 0.0) return open_fraction();
  // The tangent of pi/2 in double precision is finite and large.
  return at(thickness_ * std::tan(std::clamp(theta, 0.0, pi / 2.0)), phi);
}

double ScreenTransmittance::cut_off() const { return std::atan2(longest_chord_, thickness_); }

}  // namespace gpu_shading
