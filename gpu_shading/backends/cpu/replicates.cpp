#include "backends/cpu/replicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <numeric>

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
  constexpr double plastic = 0.7548776662466927;  // the plastic number's reciprocal
  auto const number = static_cast<double>(answers_.size() + 1);
  TileGrid grid;
  grid.rows = rows();
  grid.width = columns_ > 0 ? columns_ : grid.rows;
  grid.shear = glm::fract(number * (plastic * plastic));
  grid.shift = glm::fract(number * glm::dvec2(plastic, golden));
  return grid;
}

bool Replicates::add(RowSums const& sums) {
  double const own = total(sums.own);
  if (own == 0.0) return false;
  Answer answer;
  answer.rows = static_cast<double>(rows());
  answer.turn = turn();
  std::vector<double> residual(sums.own.size());
  for (std::vector<double> const& lit : sums.lit) {
    double const fraction = total(lit) / own;
    std::transform(lit.begin(), lit.end(), sums.own.begin(), residual.begin(),
                   [&](double of_row, double all) { return (of_row - fraction * all) / own; });
    answer.parts.push_back({fraction, variance_of_sum(residual)});
  }
  answers_.push_back(std::move(answer));
  return true;
}

Replicates::ByTurn Replicates::variances(std::size_t part) const {
  ByTurn sums{};
  ByTurn rows{};
  for (Answer const& answer : answers_) {
    sums.at(answer.turn) += answer.rows * answer.parts[part].variance * cube(answer.rows);
    rows.at(answer.turn) += answer.rows;
  }
  std::ranges::transform(sums, rows, sums.begin(), std::divides());
  return sums;
}

Replicates::Spread Replicates::spread(std::size_t part) const {
  ByTurn const variances = this->variances(part);
  double const mean_variance =
      std::accumulate(variances.begin(), variances.end(), 0.0) / replicates_at_once;
  constexpr double share_of_mean = 0.2;
  constexpr double none = 1e-30;
  double weights = 0.0;
  double mean = 0.0;
  double squares = 0.0;
  for (Answer const& answer : answers_) {
    double const expected =
        share_of_mean * mean_variance + (1.0 - share_of_mean) * variances.at(answer.turn) + none;
    double const weight = cube(answer.rows) / expected;
    double const fraction = answer.parts[part].fraction;
    double const off = fraction - mean;
    weights += weight;
    mean += off * weight / weights;
    squares += weight * off * (fraction - mean);
  }
  // As many times what is expected.
  constexpr double much = 4.0;
  double const freedom = static_cast<double>(answers_.size()) - 1.0;
  Spread const found{mean, squares / (freedom * weights), freedom, part};
  constexpr double freedom_of_expected = 6.0;
  double const all = freedom + freedom_of_expected;
  Spread const pooled{mean, (squares + freedom_of_expected) / (all * weights), all, part};
  if (squares > much * freedom) return found;
  // Where the phases are even, the spread is much smaller. Three answers may agree by chance.
  bool const by_spread =
      answers_.size() > replicates_at_once && found.uncertainty() < pooled.uncertainty();
  return by_spread ? found : pooled;
}

Replicates::Spread Replicates::largest_spread() const {
  Spread largest;
  for (std::size_t part = 0; part < answers_.front().parts.size(); ++part) {
    Spread const of_part = spread(part);
    if (of_part.uncertainty() > largest.uncertainty()) largest = of_part;
  }
  return largest;
}

double Replicates::Spread::uncertainty() const { return student_t(freedom) * std::sqrt(variance); }

void Replicates::leave_poor_turns(std::size_t part) {
  ByTurn const variances = this->variances(part);
  auto const best = std::ranges::min_element(variances);
  constexpr double poor = 5.0;
  for (std::size_t turn = 0; turn < replicates_at_once; ++turn) {
    bool const is_poor = variances.at(turn) > poor * *best;
    turns_.at(turn) = is_poor ? static_cast<std::size_t>(best - variances.begin()) : turn;
  }
}

bool Replicates::done() {
  if (answers_.size() % replicates_at_once != 0) return false;
  Spread const spread = largest_spread();
  double const excess = spread.uncertainty() / max_error_;
  if (excess <= 1.0) return true;
  constexpr double max_rows = 20000.0;
  constexpr double max_rows_of_pixels = 5000.0;
  // With the weights of the next ones, a little less than the error that is wanted.
  constexpr double spare = 1.1;
  double const freedom = spread.freedom + replicates_at_once;
  double const wanted = spare * excess * student_t(freedom) / student_t(spread.freedom);
  double cubes = 0.0;
  for (Answer const& answer : answers_) cubes += cube(answer.rows);
  double const more = cubes * (wanted * wanted - 1.0) / replicates_at_once;
  rows_ = std::clamp(std::cbrt(more), 0.5 * rows_, 6.0 * rows_);
  leave_poor_turns(spread.part);
  return rows_ > (columns_ > 0 ? max_rows : max_rows_of_pixels);
}

std::vector<double> Replicates::means() const {
  std::vector<double> means;
  for (std::size_t part = 0; part < answers_.front().parts.size(); ++part) {
    means.push_back(spread(part).mean);
  }
  return means;
}

}  // namespace gpu_shading
