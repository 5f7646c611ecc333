#include "sun/sampling/sun_arcs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gpu_shading {
namespace {

using std::numbers::pi;

// Steps along the arcs are longer than those between them; the ratio works best for the closed-form
// scenes of tests/bench/sampling_error.
constexpr double elongation = 1.4;

// Smaller than the sun's motion towards the horizon in the ten seconds before sunset.
constexpr double from_horizon = 0.04 * pi / 180.0;

// Declinations at which the sun rises.
struct Range {
  double low;
  double high;
};

Range lit_declinations(double latitude) {
  // The part of the arc above the horizon then has room for two directions.
  constexpr double margin = 0.2 * pi / 180.0;
  double const reach = pi / 2.0 - std::abs(latitude) - margin;
  if (latitude >= 0.0) return {std::max(-max_declination, -reach), max_declination};
  return {-max_declination, std::min(max_declination, reach)};
}

// In steps. Every other arc is offset by half a step. The others miss noon by a fifth, before and
// after it in turn: at noon the sun is in the plane of walls that face east and west.
double shift_of(int arc) {
  constexpr std::array<double, 4> shifts{0.2, 0.5, -0.2, 0.5};
  return shifts.at(static_cast<std::size_t>(arc) % shifts.size());
}

void add_arc(double declination, double latitude, double step, double shift,
             std::vector<HourDirection>& directions) {
  double const sunset = sunset_hour_angle(declination, latitude);
  auto const steps = std::max(2, static_cast<int>(std::lround(2.0 * sunset / step)));
  if (sunset == pi) {
    for (int i = 0; i < steps; ++i) {
      directions.push_back({declination, (2.0 * (i + shift) / steps - 1.0) * pi});
    }
    return;
  }
  double const end = std::max(sunset - from_horizon, 0.0);
  directions.push_back({declination, -end});
  for (int i = shift > 0.0 ? 0 : 1; i < steps; ++i) {
    directions.push_back({declination, (2.0 * (i + shift) / steps - 1.0) * end});
  }
  directions.push_back({declination, end});
}

std::vector<HourDirection> spread(double latitude, int arcs, double elongated) {
  auto const [low, high] = lit_declinations(latitude);
  double const apart = (high - low) / (arcs - 1);
  std::vector<HourDirection> directions;
  for (int arc = 0; arc < arcs; ++arc) {
    add_arc(low + arc * apart, latitude, elongated * apart, shift_of(arc), directions);
  }
  return directions;
}

}  // namespace

std::vector<HourDirection> spread_on_arcs(double latitude, std::size_t max_count) {
  std::vector<HourDirection> best;
  constexpr int max_arcs = 60;
  for (int arcs = 3; arcs <= max_arcs; ++arcs) {
    // Steps along the arcs compensate for the whole number of arcs.
    for (double const slack : {0.92, 0.96, 1.0, 1.04, 1.08}) {
      auto directions = spread(latitude, arcs, elongation * slack);
      if (directions.size() <= max_count && directions.size() > best.size()) best = directions;
    }
  }
  return best;
}

double azimuth_from_noon(SunDirection direction, double latitude) {
  return latitude >= 0.0 ? std::remainder(direction.azimuth - pi, 2.0 * pi)
                         : std::remainder(-direction.azimuth, 2.0 * pi);
}

std::vector<AzimuthDay> sample_azimuths(double latitude, double step) {
  constexpr int days_apart = 14;
  constexpr int instants = 8640;  // times of a day at which azimuths are searched
  std::vector<AzimuthDay> days;
  for (int day = 1; day <= 365; day += days_apart) {
    double const declination = sun_of_day(day).declination;
    double const sunset = sunset_hour_angle(declination, latitude);
    std::vector<std::pair<int, HourDirection>> crossed;
    double before = 0.0;
    for (int i = 0; i <= instants && sunset > 0.0; ++i) {
      HourDirection const direction{declination, (2.0 * i / instants - 1.0) * sunset};
      double const azimuth = azimuth_from_noon(to_direction(direction, latitude), latitude) / step;
      bool const through_midnight = std::abs(azimuth - before) > pi / step;
      if (i > 0 && !through_midnight && std::floor(azimuth) != std::floor(before)) {
        crossed.emplace_back(static_cast<int>(std::floor(std::max(azimuth, before))), direction);
      }
      before = azimuth;
    }
    std::ranges::stable_sort(crossed, {}, &std::pair<int, HourDirection>::first);
    AzimuthDay found{day, crossed.empty() ? 0 : crossed.front().first, {}};
    for (auto const& [multiple, direction] : crossed) {
      // Between the tropics, the sun may pass an azimuth twice a day; the grid has it once.
      if (multiple == found.first + static_cast<int>(found.directions.size())) {
        found.directions.push_back(direction);
      }
    }
    days.push_back(std::move(found));
  }
  return days;
}

}  // namespace gpu_shading
