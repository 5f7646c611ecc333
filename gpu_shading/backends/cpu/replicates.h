#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "scene/turns.h"
#include "view/tile.h"

namespace gpu_shading {

// What the rows of a lattice of samples meet.
struct RowSums {
  std::vector<double> own;               // samples of the receiver
  std::vector<std::vector<double>> lit;  // their luminance, or that on each interior surface
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

  // Adds the answer by that lattice. False if it does not meet the receiver.
  bool add(RowSums const& sums);

  // Whether there are enough. May choose more rows for those that follow.
  bool done();

  std::vector<double> means() const;  // fractions
  // The error that 99 % of such means stay within, the largest of all parts.
  double uncertainty() const { return largest_spread().uncertainty(); }

 private:
  struct Part {
    double fraction = 0.0;
    double variance = 0.0;  // where phases are random
  };
  struct Answer {
    double rows = 0.0;
    std::size_t turn = 0;
    std::vector<Part> parts;
  };
  using ByTurn = std::array<double, replicates_at_once>;
  int rows() const;
  // The variance of answers by one row, where phases are random.
  ByTurn variances(std::size_t part) const;
  // The variance of a mean, known from so many independent numbers.
  struct Spread {
    double mean = 0.0;
    double variance = 0.0;
    double freedom = 1.0;
    std::size_t part = 0;

    double uncertainty() const;
  };
  Spread spread(std::size_t part) const;
  Spread largest_spread() const;
  // Chooses the best turn in place of those along edges.
  void leave_poor_turns(std::size_t part);

  double max_error_;
  int columns_;
  double rows_;                                                 // of each of the next lattices
  std::array<std::size_t, replicates_at_once> turns_{0, 1, 2};  // of the next lattices
  std::vector<Answer> answers_;
};

}  // namespace gpu_shading
