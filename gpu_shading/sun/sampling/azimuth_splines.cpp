#include "sun/sampling/azimuth_splines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "gpu_shading/sun_position.h"

namespace gpu_shading {
namespace {

using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;

// Interpolates values at equal steps. With fewer than five values, which give no slope at the ends,
// the ends are level; fewer than three are not interpolated by a spline.
Spline through(std::vector<double> values, double start, double step) {
  constexpr std::size_t enough = 5;
  if (values.size() == 1) values.push_back(values.front());
  if (values.size() == 2) {
    values.insert(values.begin() + 1, 0.5 * (values.front() + values.back()));
    step *= 0.5;
  }
  if (values.size() >= enough) return Spline(values.begin(), values.end(), start, step);
  return Spline(values.begin(), values.end(), start, step, 0.0, 0.0);
}

// Index of the nearest to `i` that is true, or none.
std::optional<std::size_t> nearest(std::vector<bool> const& wanted, std::size_t i) {
  for (std::size_t away = 0; away < wanted.size(); ++away) {
    if (away <= i && wanted[i - away]) return i - away;
    if (i + away < wanted.size() && wanted[i + away]) return i + away;
  }
  return std::nullopt;
}

}  // namespace

AzimuthSplines::AzimuthSplines(SunlitTable const& table, std::vector<AzimuthDay> const& days,
                               double latitude, double step)
    : latitude_(latitude) {
  for (auto const& column : table.columns()) {
    auto const& all_lit = table.lit(column.receiver);
    std::vector<Day> of_days;
    std::vector<bool> known;
    std::size_t sample = 0;
    for (auto const& day : days) {
      std::vector<double> values;
      std::vector<bool> lit;
      for (std::size_t i = 0; i < day.directions.size(); ++i, ++sample) {
        values.push_back(column.fractions[sample]);
        lit.push_back(all_lit[sample]);
      }
      // Where the receiver faces away, the value of the nearest azimuth at which it does not.
      auto filled = values;
      known.push_back(false);
      for (std::size_t i = 0; i < values.size(); ++i) {
        auto const from = nearest(lit, i);
        if (!from) break;
        filled[i] = values[*from];
        known.back() = true;
      }
      double const first = day.first * step;
      double const last = first + (static_cast<double>(values.size()) - 1.0) * step;
      if (filled.empty()) filled.push_back(0.0);
      of_days.push_back({first, std::max(first, last), through(std::move(filled), first, step)});
    }
    // Days on which it always faces away take the nearest day on which it does not.
    auto all_days = of_days;
    for (std::size_t i = 0; i < all_days.size(); ++i) {
      if (auto const from = nearest(known, i)) all_days[i] = of_days[*from];
    }
    days_of_column_.push_back(std::move(all_days));
  }
  for (std::size_t i = 0; i < days.size(); ++i) {
    std::vector<double> unit(days.size(), 0.0);
    unit[i] = 1.0;
    weight_of_day_.push_back(through(std::move(unit), days[0].day, days[1].day - days[0].day));
  }
  for (int day = 1; day <= 365; ++day) declinations_.push_back(sun_of_day(day).declination);
}

std::vector<double> AzimuthSplines::weights_of(double declination) const {
  // The first and the last half of the year, from solstice to solstice.
  auto const top = std::ranges::max_element(declinations_);
  auto const nearest_day = [&](auto from, auto to) {
    auto const nearest = std::min_element(from, to, [&](double a, double b) {
      return std::abs(a - declination) < std::abs(b - declination);
    });
    return static_cast<double>(nearest - declinations_.begin() + 1);
  };
  double const spring = nearest_day(declinations_.begin(), top);
  double const autumn = nearest_day(top, declinations_.end());
  std::vector<double> weights;
  weights.reserve(weight_of_day_.size());
  for (auto const& weight : weight_of_day_) {
    weights.push_back(0.5 * (weight(spring) + weight(autumn)));
  }
  return weights;
}

std::vector<double> AzimuthSplines::at(SunDirection direction) const {
  double const azimuth = azimuth_from_noon(direction, latitude_);
  auto const weights = weights_of(to_hour_direction(direction, latitude_).declination);
  std::vector<double> fractions;
  fractions.reserve(days_of_column_.size());
  for (auto const& days : days_of_column_) {
    double sum = 0.0;
    for (std::size_t i = 0; i < days.size(); ++i) {
      sum += weights[i] * days[i].spline(std::clamp(azimuth, days[i].first, days[i].last));
    }
    fractions.push_back(sum);
  }
  return fractions;
}

}  // namespace gpu_shading
