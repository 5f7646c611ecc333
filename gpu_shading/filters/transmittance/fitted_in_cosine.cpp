#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "gpu_shading/transmittance.h"

namespace gpu_shading {
namespace {

constexpr std::size_t points = 10;  // 0, 10, .. 90 degrees
constexpr std::size_t powers = 6;   // of the cosine, from 1

using Column = std::array<double, points>;
using Coefficients = std::array<double, powers>;  // from power 1

double dot(Column const& a, Column const& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// Each power of the cosines, made orthogonal to those below it (modified Gram-Schmidt): the normal
// equations of the powers themselves have a condition of 1e9.
Coefficients fit(Transmittance const& model) {
  Column cosines{};
  Column rest{};  // of the values, not yet fitted
  for (std::size_t k = 0; k < points; ++k) {
    double const angle = std::numbers::pi / 18.0 * static_cast<double>(k);
    cosines[k] = k + 1 < points ? std::cos(angle) : 0.0;
    rest[k] = model(angle);
  }
  std::array<Column, powers> basis{};
  std::array<Coefficients, powers> in_powers{};  // of each column of the basis
  Coefficients fitted{};
  for (std::size_t j = 0; j < powers; ++j) {
    Column& column = basis[j];
    for (std::size_t k = 0; k < points; ++k)
      column[k] = j == 0 ? cosines[k] : basis[j - 1][k] * cosines[k];
    if (j == 0) {
      in_powers[j][0] = 1.0;
    } else {
      std::copy(in_powers[j - 1].begin(), in_powers[j - 1].end() - 1, in_powers[j].begin() + 1);
    }
    for (std::size_t i = 0; i < j; ++i) {
      double const share = dot(column, basis[i]) / dot(basis[i], basis[i]);
      for (std::size_t k = 0; k < points; ++k) column[k] -= share * basis[i][k];
      for (std::size_t p = 0; p < powers; ++p) in_powers[j][p] -= share * in_powers[i][p];
    }
    double const share = dot(rest, column) / dot(column, column);
    for (std::size_t k = 0; k < points; ++k) rest[k] -= share * column[k];
    for (std::size_t p = 0; p < powers; ++p) fitted[p] += share * in_powers[j][p];
  }
  return fitted;
}

}  // namespace

Transmittance Transmittance::fitted_in_cosine(Transmittance const& model) {
  return Transmittance([coefficients = fit(model)](double angle) {
    double const x = std::max(0.0, std::cos(angle));
    double value = 0.0;
    for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) value = (value + *c) * x;
    return value;
  });
}

}  // namespace gpu_shading
