#include "gpu_shading/transmittance.h"

#include <fmt/format.h>
#include <math.h>  // Boost 1.74's pchip.hpp needs a global isnan, which <cmath> does not promise

#include <algorithm>
#include <boost/math/interpolators/pchip.hpp>
#include <cmath>
#include <cstddef>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

#include "filters/transmittance/polynomial.h"
#include "filters/transmittance/transmittance_filter.h"
#include "gpu_shading/error.h"

namespace gpu_shading {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

void check(double value, double degrees, double tolerance = 0.0) {
  // Written so that NaN fails.
  if (value >= -tolerance && value <= 1.0 + tolerance) return;
  throw Error(
      fmt::format("transmittance is {:.9g} at {:.4g} degrees, expected 0 to 1", value, degrees));
}

void check_terms(std::vector<double> const& coefficients) {
  constexpr std::size_t most = 9;
  if (coefficients.empty() || coefficients.size() > most) {
    throw Error(
        fmt::format("polynomial has {} coefficients, expected 1 to {}", coefficients.size(), most));
  }
}

// `model` takes degrees.
template <typename Model>
void check_everywhere(Model const& model) {
  for (int tenths = 0; tenths <= 900; ++tenths) check(model(tenths / 10.0), tenths / 10.0, 1e-9);
}

void check_table(std::vector<double> const& angles, std::vector<double> const& values) {
  if (angles.size() != values.size()) {
    throw Error(fmt::format("table has {} angles and {} transmittances, expected equal numbers",
                            angles.size(), values.size()));
  }
  if (angles.size() < 2) {
    throw Error(fmt::format("table has {} points, expected 2 or more", angles.size()));
  }
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!(angles[i] >= 0.0 && angles[i] <= 90.0)) {
      throw Error(fmt::format("angle is {:.9g} degrees, expected 0 to 90", angles[i]));
    }
    if (i > 0 && angles[i] <= angles[i - 1]) {
      throw Error(fmt::format("angle of {:.9g} degrees follows {:.9g}, expected increasing angles",
                              angles[i], angles[i - 1]));
    }
    check(values[i], angles[i]);
  }
}

// The points on either side of x, which lies within their range.
double straight(std::vector<double> const& xs, std::vector<double> const& ys, double x) {
  auto const above = std::upper_bound(xs.begin() + 1, xs.end() - 1, x);
  auto const i = static_cast<std::size_t>(above - xs.begin());
  return std::lerp(ys[i - 1], ys[i], (x - xs[i - 1]) / (xs[i] - xs[i - 1]));
}

}  // namespace

Transmittance::Transmittance() : Transmittance([](double) { return 0.0; }) {}

Transmittance::Transmittance(std::function<double(double)> model) : model_(std::move(model)) {}

double Transmittance::operator()(double angle) const {
  return std::clamp(model_(std::clamp(angle, 0.0, std::numbers::pi / 2.0)), 0.0, 1.0);
}

Transmittance Transmittance::constant(double value) {
  if (!(value >= 0.0 && value <= 1.0)) {
    throw Error(fmt::format("transmittance is {:.9g}, expected 0 to 1", value));
  }
  return Transmittance([value](double) { return value; });
}

Transmittance Transmittance::product(Transmittance const& model, double factor) {
  if (!(factor >= 0.0 && factor <= 1.0)) {
    throw Error(fmt::format("factor is {:.9g}, expected 0 to 1", factor));
  }
  return Transmittance([model, factor](double angle) { return factor * model(angle); });
}

Transmittance Transmittance::with_normal(Transmittance const& model, double normal) {
  if (!(normal >= 0.0 && normal <= 1.0)) {
    throw Error(fmt::format("transmittance is {:.9g}, expected 0 to 1", normal));
  }
  double const before = model(0.0);
  if (before <= 0.0 && normal > 0.0) {
    throw Error(
        fmt::format("transmittance is {:.9g} at normal incidence of an opaque model", normal));
  }
  if (normal <= 0.0) return {};
  return Transmittance([model, factor = normal / before](double angle) {
    return std::min(factor * model(angle), 1.0);
  });
}

Transmittance Transmittance::polynomial_in_degrees(std::vector<double> coefficients) {
  check_terms(coefficients);
  check_everywhere([&](double degrees) { return polynomial(coefficients, degrees); });
  return Transmittance([coefficients = std::move(coefficients)](double angle) {
    return polynomial(coefficients, angle / degree);
  });
}

Transmittance Transmittance::polynomial_in_cosine(std::vector<double> coefficients) {
  check_terms(coefficients);
  check_everywhere(
      [&](double degrees) { return polynomial(coefficients, std::cos(degrees * degree)); });
  return Transmittance([coefficients = std::move(coefficients)](double angle) {
    return polynomial(coefficients, std::cos(angle));
  });
}

Transmittance Transmittance::table(std::vector<double> angles, std::vector<double> values) {
  check_table(angles, values);
  double const first = angles.front();
  double const last = angles.back();
  auto const within = [first, last](double angle) {
    return std::clamp(angle / degree, first, last);
  };
  if (angles.size() < 4) {
    return Transmittance([=](double angle) { return straight(angles, values, within(angle)); });
  }
  boost::math::interpolators::pchip<std::vector<double>> const curve(std::move(angles),
                                                                     std::move(values));
  return Transmittance([=](double angle) { return curve(within(angle)); });
}

double factor_at(AngularTransmittance const& kind, double cosine) {
  return std::clamp((*kind.model)(std::acos(cosine)), 0.0, 1.0);
}

void add_values(FilterDigest& digest, AngularTransmittance const& kind) {
  digest.add_shared(kind.model.get(), [&](FilterDigest& shared) {
    constexpr int samples_a_degree = 100;
    for (int i = 0; i <= 90 * samples_a_degree; ++i) {
      shared.add((*kind.model)(glm::radians(static_cast<double>(i) / samples_a_degree)));
    }
  });
}

}  // namespace gpu_shading
