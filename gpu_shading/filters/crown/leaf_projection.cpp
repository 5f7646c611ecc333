#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "gpu_shading/crown.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

// The projection of leaves that are all inclined alike and face all compass directions (Ross, 1981;
// Warren Wilson, 1960), by the cosines of the beam's zenith angle and of the inclination.
double projection_of(double cosine, double leaf_cosine) {
  double const level = cosine * leaf_cosine;
  double const upright = std::sqrt((1.0 - cosine * cosine) * (1.0 - leaf_cosine * leaf_cosine));
  if (upright <= level) return level;
  double const psi = std::acos(level / upright);
  // level x (1 + 2 / pi (tan psi - psi)), whose tangent may be infinite.
  return level * (1.0 - 2.0 / pi * psi) + 2.0 / pi * upright * std::sin(psi);
}

// The share of leaves by inclination, de Wit (1965): 2 / pi (1 +- cos 2 theta).
double integral(double cosine, double sign) {
  constexpr int steps = 1024;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    double const inclination = (i + 0.5) * 0.5 * pi / steps;
    double const share = 2.0 / pi * (1.0 + sign * std::cos(2.0 * inclination));
    sum += share * projection_of(cosine, std::cos(inclination));
  }
  return sum * 0.5 * pi / steps;
}

// By the cosine of the zenith angle; between them it is nearly a parabola.
class Table {
 public:
  explicit Table(double sign) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_.at(i) = integral(static_cast<double>(i) / last, sign);
    }
  }

  double operator()(double cosine) const {
    double const position = cosine * last;
    auto const below = std::min(static_cast<std::size_t>(position), intervals - 1);
    double const part = position - static_cast<double>(below);
    return values_.at(below) + part * (values_.at(below + 1) - values_.at(below));
  }

 private:
  static constexpr std::size_t intervals = 1024;
  static constexpr auto last = static_cast<double>(intervals);

  std::array<double, intervals + 1> values_{};
};

}  // namespace

double leaf_projection(LeafAngles angles, double cosine) {
  constexpr double spherical = 0.5;
  double const above = std::min(1.0, std::abs(cosine));
  switch (angles) {
    case LeafAngles::planophile: {
      static Table const level(1.0);
      return level(above);
    }
    case LeafAngles::erectophile: {
      static Table const upright(-1.0);
      return upright(above);
    }
    case LeafAngles::spherical:
      break;
  }
  return spherical;
}

}  // namespace gpu_shading
