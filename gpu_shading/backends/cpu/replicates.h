#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "backends/interface/view_backend.h"
#include "scene/turns.h"
#include "view/tile.h"

namespace gpu_shading {

// Of all schedules, at which errors are measured: 0, 1/2 and 1.
inline constexpr std::size_t measured_factors = 3;

// What the rows of a lattice of samples meet.
struct RowSums {
  std::vector<double> own;  // samples of the receiver
  // Their luminance, or that on each interior surface; behind scheduled shades for each of the
  // measured factors.
  std::vector<std::vector<double>> lit;
  // Of each part, behind scheduled shades: its sums over all rows.
  std::vector<std::vector<LuminanceSums::Scheduled>> scheduled;

  std::size_t parts() const { return scheduled.empty() ? lit.size() : scheduled.size(); }
};

double total(std::vector<double> const& rows);

// Independent answers to one question, from lattices of rows of other slopes, distances and
// offsets. Their spread measures the error of their mean, whatever repeats in the view.
//
// Three answers alone tell little about a spread. Each therefore brings an estimate of its own
// error from the differences between its rows, which holds where the phases of shadow edges against
// the rows are random; the spread tells whether they are.
class Replicates {
 public:
  // For a `max_error` of fractions, by so many rows each, which may suffice. With 0, there are as
  // many columns as rows.
  Replicates(double max_error, double rows, int columns);

  // The next lattice, to be used on the tile turned by this slope.
  TileGrid grid() const;
  std::size_t turn() const { return turns_.at(answers_.size() % replicates_at_once); }

  // Adds the answer by that lattice. Where it does not meet the receiver, doubles the rows; false
  // if they are as many as there may be.
  bool add(RowSums sums);

  // Whether there are enough. May choose more rows for those that follow.
  bool done();

  // Once they are enough.
  std::vector<LuminanceSums> means() const;  // fractions, by part
  // The error that 99 % of such means stay within, the largest of all parts.
  double uncertainty() const { return largest_spread().uncertainty(); }

 private:
  struct Fraction {
    double value = 0.0;
    double variance = 0.0;  // where phases are random
  };
  struct Answer {
    double rows = 0.0;
    std::size_t turn = 0;
    std::vector<Fraction> fractions;
    std::vector<std::vector<LuminanceSums::Scheduled>> scheduled;
  };
  using ByTurn = std::array<double, replicates_at_once>;
  // The variance of a mean, known from so many independent numbers.
  struct Spread {
    double mean = 0.0;
    double variance = 0.0;
    double expected = 0.0;  // variance, where phases are random
    double freedom = 1.0;
    std::vector<double> weights = {};  // of answers, 1 in all
    ByTurn variances{};                // of answers by one row, where phases are random

    double uncertainty() const;
  };

  double max_rows() const { return columns_ > 0 ? 20000.0 : 5000.0; }
  int rows() const;
  ByTurn variances(std::size_t fraction) const;
  // With the variance that is expected of each answer.
  Spread spread(std::size_t fraction, std::span<double const> expected) const;
  Spread spread(std::size_t fraction) const;
  Spread const& largest_spread() const;
  // Chooses the best turn in place of those along edges.
  void leave_poor_turns(ByTurn const& variances);

  double max_error_;
  int columns_;
  double rows_;                                                 // of each of the next lattices
  std::array<std::size_t, replicates_at_once> turns_{0, 1, 2};  // of the next lattices
  std::vector<Answer> answers_;
  std::vector<Spread> spreads_;  // by fraction
};

}  // namespace gpu_shading
