#include "transport/solar_hours.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gpu_shading {
namespace {

constexpr int most_probes = 48;

double square(double x) { return x * x; }

// The mean product of the values of different replicates: the square of their mean without noise of
// its own.
double mean_product(std::vector<double> const& values) {
  double sum = 0.0;
  double squares = 0.0;
  for (double const value : values) {
    sum += value;
    squares += square(value);
  }
  auto const count = double(values.size());
  return (square(sum) - squares) / (count * (count - 1.0));
}

}  // namespace

SolarHours::SolarHours(TransportRequest const& request) {
  std::vector<double> up_to;
  for (auto const& hour : request.hours) {
    auto const sun = to_vector(to_direction(hour.sun, request.latitude));
    if (sun.z <= 0.0 || hour.beam + hour.diffuse <= 0.0) continue;
    hours.push_back(hour);
    suns.push_back(sun);
    up_to.push_back(beam += hour.beam);
  }
  for (int i = 0; i < most_probes && beam > 0.0; ++i) {
    double const place = (i + 0.5) / most_probes * beam;
    auto const found = std::upper_bound(up_to.begin(), std::prev(up_to.end()), place);
    auto const hour = static_cast<std::size_t>(found - up_to.begin());
    if (probes.empty() || probes.back() != hour) probes.push_back(hour);
  }
}

Errors errors_of(std::vector<Replicate> const& replicates, SolarHours const& year,
                 ReceiverHours const& receiver, TransportRequest const& request) {
  auto const count = double(replicates.size());
  double sky = 0.0;
  double sky_direct = 0.0;
  std::vector<double> hourly(year.hours.size(), 0.0);
  for (auto const& replicate : replicates) {
    sky += replicate.sky.sum() / count;
    sky_direct += replicate.sky_direct / count;
    for (std::size_t h = 0; h < hourly.size(); ++h) hourly[h] += replicate.hourly[h] / count;
  }
  std::vector<double> totals;
  totals.reserve(hourly.size());
  std::vector<double> sums(replicates.size(), 0.0);  // of differences from the mean
  double all = 0.0;
  double squares = 0.0;
  for (std::size_t h = 0; h < year.hours.size(); ++h) {
    auto const& hour = year.hours[h];
    double const total =
        std::max(hour.beam * (hourly[h] + receiver.direct[h]) + hour.diffuse * (sky + sky_direct),
                 receiver.least[h]);
    totals.push_back(total);
    if (total <= 0.0) continue;
    all += total;
    for (std::size_t r = 0; r < replicates.size(); ++r) {
      double const off = hour.beam * (replicates[r].hourly[h] - hourly[h]) +
                         hour.diffuse * (replicates[r].sky.sum() - sky);
      sums[r] += off;
      squares += square(off) / total;
    }
  }
  Errors errors;
  if (all <= 0.0) return errors;
  double const freedom = count * (count - 1.0);
  errors.noise = std::sqrt(squares / freedom / all);
  double of_sums = 0.0;
  for (double const sum : sums) of_sums += square(sum);
  errors.annual_noise = std::sqrt(of_sums / freedom) / all;

  if (year.probes.empty()) return errors;
  auto const probes = double(year.probes.size());
  double const share = year.beam / all;  // each probe stands for as much of the beam as any other
  std::vector<double> mean_gaps;         // by replicate
  mean_gaps.reserve(replicates.size());
  for (auto const& replicate : replicates) {
    mean_gaps.push_back(share / probes *
                        std::accumulate(replicate.gaps.begin(), replicate.gaps.end(), 0.0));
  }
  errors.annual_interpolation = std::sqrt(std::max(0.0, mean_product(mean_gaps)));
  std::vector<double> squared_gaps;  // by probe
  for (std::size_t i = 0; i < year.probes.size(); ++i) {
    std::vector<double> gaps;
    gaps.reserve(replicates.size());
    for (auto const& replicate : replicates) gaps.push_back(replicate.gaps[i]);
    auto const h = year.probes[i];
    squared_gaps.push_back(
        totals[h] > 0.0 ? share * year.hours[h].beam * mean_product(gaps) / totals[h] : 0.0);
  }
  double const mean = std::accumulate(squared_gaps.begin(), squared_gaps.end(), 0.0) / probes;
  double variance = 0.0;
  for (double const gap : squared_gaps) variance += square(gap - mean) / probes;
  errors.interpolation = std::sqrt(std::max(0.0, mean));
  bool const sure = mean - 2.0 * std::sqrt(variance / probes) > 0.5 * square(request.hourly);
  errors.needs_finer_table =
      sure || errors.interpolation > std::max(0.7 * request.hourly, 2.0 * errors.noise);
  return errors;
}

}  // namespace gpu_shading
