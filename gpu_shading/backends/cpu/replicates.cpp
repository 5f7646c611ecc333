#include "backends/cpu/replicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "geometry/r2_sequence.h"

namespace gpu_shading {
namespace {

// Of both tails, 1 % in all.
double student_t(double degrees_of_freedom) {
  constexpr std::array quantiles{63.66, 9.925, 5.841, 4.604, 4.032, 3.707, 3.499, 3.355, 3.250};
  auto const number = static_cast<std::size_t>(std::max(1.0, degrees_of_freedom));
  if (number <= quantiles.size()) return quantiles.at(number - 1);
  // Abramowitz and Stegun (1964), 26.7.5, to first order.
  constexpr double normal = 2.576;
  return normal + (normal * normal * normal + normal) / (4.0 * degrees_of_freedom);
}

// The inverse of the variance by a number of rows, between that behind jumps, whose square it is,
// and behind kinks, whose fourth power it is.
double cube(double rows) { return rows * rows * rows; }

// The sum of squared second differences between rows `step` apart.
double roughness(std::vector<double> const& rows, std::size_t step) {
  double sum = 0.0;
  for (std::size_t i = 2 * step; i < rows.size(); ++i) {
    double const difference = rows[i - 2 * step] - 2.0 * rows[i - step] + rows[i];
    sum += difference * difference;
  }
  return sum;
}

// The variance of the sum of rows, one of many at random offsets. With the second differences d of
// what rows meet as a function of their height, it is sum(d^2) / 24 for jumps, / 480 for kinks and
// / 6 for what is thinner than a row's distance. Which of these it is shows at twice the distance,
// where the sum is 1, 4 and 1/2 times as large.
double variance_of_sum(std::vector<double> const& rows) {
  double const near = roughness(rows, 1);
  double const far = 0.5 * roughness(rows, 2);
  if (near == 0.0) return 0.0;
  double const ratio = std::clamp(far / near, 0.5, 4.0);
  return near / (24.0 * ratio * ratio);
}

}  // namespace

double total(std::vector<double> const& rows) {
  return std::accumulate(rows.begin(), rows.end(), 0.0);
}

Replicates::Replicates(double max_error, double rows, int columns)
    : max_error_(max_error), columns_(columns), rows_(std::max(4.0, rows)) {}

int Replicates::rows() const {
  // With equal numbers, two lattices could alias alike.
  constexpr std::array<double, replicates_at_once> factors{1.0, 1.13, 0.89};
  return static_cast<int>(std::lround(rows_ * factors.at(answers_.size() % replicates_at_once)));
}

TileGrid Replicates::grid() const {
  auto const number = static_cast<double>(answers_.size() + 1);
  TileGrid grid;
  grid.rows = rows();
  grid.width = columns_ > 0 ? columns_ : grid.rows;
  grid.shear = glm::fract(number * r2_step.y);
  grid.shift = glm::fract(number * glm::dvec2(r2_step.x, golden));
  return grid;
}

bool Replicates::add(RowSums sums) {
  double const own = total(sums.own);
  if (own == 0.0) {
    rows_ *= 2.0;
    return rows_ <= max_rows();
  }
  Answer answer;
  answer.rows = static_cast<double>(rows());
  answer.turn = turn();
  std::vector<double> residual(sums.own.size());
  for (std::vector<double> const& lit : sums.lit) {
    double const fraction = total(lit) / own;
    std::transform(lit.begin(), lit.end(), sums.own.begin(), residual.begin(),
                   [&](double of_row, double all) { return (of_row - fraction * all) / own; });
    answer.fractions.push_back({fraction, variance_of_sum(residual)});
  }
  answer.scheduled = std::move(sums.scheduled);
  for (auto& part : answer.scheduled) {
    for (LuminanceSums::Scheduled& each : part) each.sum /= own;
  }
  answers_.push_back(std::move(answer));
  return true;
}

Replicates::ByTurn Replicates::variances(std::size_t fraction) const {
  ByTurn sums{};
  ByTurn rows{};
  for (Answer const& answer : answers_) {
    sums.at(answer.turn) += answer.rows * answer.fractions[fraction].variance * cube(answer.rows);
    rows.at(answer.turn) += answer.rows;
  }
  std::ranges::transform(sums, rows, sums.begin(), std::divides());
  return sums;
}

Replicates::Spread Replicates::spread(std::size_t fraction,
                                      std::span<double const> expected) const {
  Spread found;
  double weights = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    double const weight = 1.0 / expected[i];
    double const value = answers_[i].fractions[fraction].value;
    double const off = value - found.mean;
    found.weights.push_back(weight);
    weights += weight;
    found.mean += off * weight / weights;
    squares += weight * off * (value - found.mean);
  }
  for (double& weight : found.weights) weight /= weights;
  found.freedom = static_cast<double>(answers_.size()) - 1.0;
  found.variance = std::max(0.0, squares) / (found.freedom * weights);  // rounding may be negative
  found.expected = 1.0 / weights;
  return found;
}

Replicates::Spread Replicates::spread(std::size_t fraction) const {
  ByTurn const variances = this->variances(fraction);
  double const mean_variance =
      std::accumulate(variances.begin(), variances.end(), 0.0) / replicates_at_once;
  constexpr double share_of_mean = 0.2;
  constexpr double none = 1e-30;
  std::vector<double> expected;
  std::vector<double> by_rows;
  for (Answer const& answer : answers_) {
    double const of_turn =
        share_of_mean * mean_variance + (1.0 - share_of_mean) * variances.at(answer.turn) + none;
    expected.push_back(of_turn / cube(answer.rows));
    by_rows.push_back(1.0 / cube(answer.rows));
  }
  Spread found = spread(fraction, expected);
  found.variances = variances;
  // As many times what is expected: then rows tell nothing.
  constexpr double much = 4.0;
  if (found.variance > much * found.expected) {
    found = spread(fraction, by_rows);
    found.variances.fill(1.0);
    return found;
  }
  constexpr double freedom_of_expected = 6.0;
  Spread pooled = found;
  pooled.freedom += freedom_of_expected;
  pooled.variance =
      (found.freedom * found.variance + freedom_of_expected * found.expected) / pooled.freedom;
  // Where the phases are even, the spread is much smaller. Three answers may agree by chance.
  bool const by_spread =
      answers_.size() > replicates_at_once && found.uncertainty() < pooled.uncertainty();
  return by_spread ? found : pooled;
}

Replicates::Spread const& Replicates::largest_spread() const {
  return *std::ranges::max_element(spreads_, {}, &Spread::uncertainty);
}

double Replicates::Spread::uncertainty() const { return student_t(freedom) * std::sqrt(variance); }

void Replicates::leave_poor_turns(ByTurn const& variances) {
  auto const best = std::ranges::min_element(variances);
  constexpr double poor = 5.0;
  for (std::size_t turn = 0; turn < replicates_at_once; ++turn) {
    bool const is_poor = variances.at(turn) > poor * *best;
    turns_.at(turn) = is_poor ? static_cast<std::size_t>(best - variances.begin()) : turn;
  }
}

bool Replicates::done() {
  if (answers_.empty() || answers_.size() % replicates_at_once != 0) return false;
  spreads_.clear();
  for (std::size_t i = 0; i < answers_.front().fractions.size(); ++i) {
    spreads_.push_back(spread(i));
  }
  Spread const& largest = largest_spread();
  double const excess = largest.uncertainty() / max_error_;
  if (!(excess > 1.0)) return true;
  // With the weights of the next ones, a little less than the error that is wanted.
  constexpr double spare = 1.1;
  double const freedom = largest.freedom + replicates_at_once;
  double const wanted = spare * excess * student_t(freedom) / student_t(largest.freedom);
  double cubes = 0.0;
  for (Answer const& answer : answers_) cubes += cube(answer.rows);
  double const more = cubes * (wanted * wanted - 1.0) / replicates_at_once;
  bool const are_most = rows_ >= max_rows();
  rows_ = std::min(std::clamp(std::cbrt(more), 0.5 * rows_, 6.0 * rows_), max_rows());
  leave_poor_turns(largest.variances);
  return are_most;
}

std::vector<LuminanceSums> Replicates::means() const {
  bool const scheduled = !answers_.front().scheduled.empty();
  std::vector<LuminanceSums> means(scheduled ? spreads_.size() / measured_factors
                                             : spreads_.size());
  for (std::size_t part = 0; part < means.size(); ++part) {
    if (!scheduled) {
      means[part].unscheduled = spreads_[part].mean;
      continue;
    }
    Spread const* largest = &spreads_[part];
    for (std::size_t i = part; i < spreads_.size(); i += means.size()) {
      if (spreads_[i].variance > largest->variance) largest = &spreads_[i];
    }
    // The same for all schedules, so that what they transmit adds up.
    std::vector<double> const& weights = largest->weights;
    std::map<std::vector<std::pair<int, int>>, double> totals;
    for (std::size_t i = 0; i < answers_.size(); ++i) {
      means[part].unscheduled += weights[i] * answers_[i].fractions[part].value;
      for (auto const& [powers, sum] : answers_[i].scheduled[part]) {
        totals[powers] += weights[i] * sum;
      }
    }
    for (auto const& [powers, sum] : totals) means[part].scheduled.push_back({powers, sum});
  }
  return means;
}

}  // namespace gpu_shading
