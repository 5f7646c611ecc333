#include "transport/solar_hours.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gpu_shading {
namespace {

constexpr int most_probes = 48;

double square(double x) { return x * x; }

double mean_of(std::vector<double> const& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double error_of_mean(std::vector<double> const& values) {
  double const mean = mean_of(values);
  double squares = 0.0;
  for (double const value : values) squares += square(value - mean);
  return std::sqrt(squares) / double(values.size());
}

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
  for (auto const& hour : request.hours) {
    auto const sun = to_vector(to_direction(hour.sun, request.latitude));
    if (sun.z <= 0.0 || hour.beam + hour.diffuse <= 0.0) continue;
    hours.push_back(hour);
    suns.push_back(sun);
  }
}

std::vector<Probe> choose_probes(SolarHours const& year, ReceiverHours const& receiver) {
  std::vector<double> costs;
  double beam = 0.0;
  double cost = 0.0;
  for (std::size_t h = 0; h < year.hours.size(); ++h) {
    auto const& hour = year.hours[h];
    double const total = std::max(hour.beam * receiver.direct[h], receiver.least[h]);
    costs.push_back(total > 0.0 ? square(hour.beam) / total : 0.0);
    beam += hour.beam;
    cost += costs.back();
  }
  std::vector<Probe> probes;
  double up_to = 0.0;
  int chosen = 0;
  for (std::size_t h = 0; h < year.hours.size() && cost > 0.0; ++h) {
    double const share = 0.5 * (year.hours[h].beam / beam + costs[h] / cost);
    up_to += share;
    int const due = std::min(static_cast<int>(std::lround(most_probes * up_to)), most_probes);
    if (due > chosen) probes.push_back({h, (due - chosen) / (most_probes * share)});
    chosen = due;
  }
  return probes;
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

  if (receiver.probes.empty()) return errors;
  auto const probes = double(receiver.probes.size());
  std::vector<double> gaps_of_year;  // by probe, as if all were like it
  std::vector<double> squared_gaps;  // the same
  for (std::size_t i = 0; i < receiver.probes.size(); ++i) {
    auto const& probe = receiver.probes[i];
    double const energy = probe.hours * year.hours[probe.hour].beam / all;
    std::vector<double> gaps;
    gaps.reserve(replicates.size());
    for (auto const& replicate : replicates) gaps.push_back(replicate.gaps[i]);
    gaps_of_year.push_back(probes * energy * mean_of(gaps));
    double const total = totals[probe.hour];
    squared_gaps.push_back(total > 0.0 ? probes * energy * year.hours[probe.hour].beam *
                                             mean_product(gaps) / total
                                       : 0.0);
  }
  // Both as what few probes say of a year, or worse: replicates are added until errors are small,
  // and those would end that look small by chance.
  errors.annual_interpolation = std::hypot(mean_of(gaps_of_year), error_of_mean(gaps_of_year));
  double const mean = mean_of(squared_gaps);
  double const unsure = error_of_mean(squared_gaps);
  errors.interpolation = std::sqrt(std::max(0.0, mean + unsure));
  bool const sure = mean - 2.0 * unsure > 0.5 * square(request.hourly);
  errors.needs_finer_table =
      sure || std::sqrt(std::max(0.0, mean)) > std::max(0.7 * request.hourly, 2.0 * errors.noise);
  return errors;
}

}  // namespace gpu_shading
