#pragma once

#include <span>

namespace gpu_shading {

// c[0] + c[1] x + c[2] x^2 + ...
inline double polynomial(std::span<double const> coefficients, double x) {
  double sum = 0.0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) sum = sum * x + *c;
  return sum;
}

}  // namespace gpu_shading
