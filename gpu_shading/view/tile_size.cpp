#include "view/tile_size.h"

#include <algorithm>
#include <cmath>

namespace gpu_shading {
namespace {

// The smallest of 1, 2, 3, 4, 6, 8, 12, ... that is not below the value.
int round_up(double side) {
  int power = 1;
  while (power < side) power *= 2;
  int const between = power / 4 * 3;
  return between >= side ? between : power;
}

int limit(double at_a_thousandth, double error, int most) {
  return std::min(most, round_up(at_a_thousandth * std::pow(1e-3 / error, 2.0 / 3.0) - 1e-6));
}

double expected_error(double along, double across, double side) {
  double const chance = (across > 0.0 ? std::max(across, 1.0) : 0.0) / side;
  double const even = 6.0 * std::sqrt(std::min(along, 25.0)) + 0.03 * along;
  return std::sqrt(chance + even * even / (side * side)) / side;
}

// In 99 % of cases.
double crowd_error(double area, double thickness, double rows) {
  constexpr double deviations = 2.576;  // of a normal distribution
  double const distance = 1.0 / (rows * thickness);
  double const cubed = distance * distance * distance;
  double const missed = cubed * distance / (3.0 + 1.6 * cubed);
  return 0.5 * deviations * std::sqrt(area * missed);
}

}  // namespace

TileSize TileSize::fixed(int side) {
  TileSize size;
  size.fixed_ = size.least_ = size.most_ = size.largest_ = side;
  return size;
}

TileSize TileSize::for_error(double error, int most) {
  constexpr int largest = 4096;
  TileSize size;
  size.error_ = error;
  size.least_ = limit(64.0, error, std::min(most, largest));
  size.most_ = limit(512.0, error, std::min(most, largest));
  size.largest_ = std::min(most, largest);
  size.screened_ = (limit(512.0, error, most) + 1) / 2;
  for (size.enough_ = 1.0; expected_error(0.0, size.enough_, size.most_) < error ||
                           expected_error(size.enough_, 0.0, size.most_) < error;) {
    size.enough_ *= 2.0;
  }
  return size;
}

int TileSize::side_behind_crowd(double area, double thickness, double other_edges) const {
  // At least for one large caster, which a sample of the crowd may have missed.
  int side = this->side(0.0, 1.0 + other_edges);
  auto const max_side = std::min(4 * most_, largest_);
  while (side < max_side && crowd_error(area, thickness, rows_on(side)) > error_) {
    side = round_up(side + 1);
  }
  return std::min(side, max_side);
}

int TileSize::side(double along, double across) const {
  if (fixed_) return *fixed_;
  int side = least_;
  while (side < most_ && expected_error(along, across, side) > error_) side = round_up(side + 1);
  return std::min(side, most_);
}

}  // namespace gpu_shading
