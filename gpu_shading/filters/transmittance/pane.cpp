// After the EnergyPlus Engineering Reference, "Window Calculation Module", "Calculation of Angular
// Properties". The reference averages the interface's reflectivity over the polarisations before
// computing the pane; EnergyPlus and this code compute the pane for each polarisation and then
// average.
#include "filters/transmittance/pane.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "filters/transmittance/polynomial.h"

namespace gpu_shading {
namespace {

// Normalised to 1 at normal incidence; the second of each pair is transmittance plus reflectance.
constexpr Quartic clear_transmittance{-0.0015, 3.355, -3.840, 1.460, 0.0288};
constexpr Quartic clear_both{0.999, -0.563, 2.043, -2.532, 1.054};
constexpr Quartic bronze_transmittance{-0.002, 2.813, -2.341, -0.05725, 0.599};
constexpr Quartic bronze_both{0.997, -1.868, 6.513, -7.862, 3.225};
constexpr double clear_above = 0.645;

double square(double x) { return x * x; }

// Reflectivity of one interface at normal incidence, from the pane's transmittance and reflectance.
double interface_reflectivity(double t, double r) {
  double const beta = square(t) - square(r) + 2.0 * r + 1.0;
  double const twice = 2.0 - r;
  double const rho =
      (beta - std::sqrt(std::max(0.0, square(beta) - 4.0 * twice * r))) / (2.0 * twice);
  return std::clamp(rho, 0.0, 1.0 - 1e-12);  // a mirror's refractive index is infinite
}

// exp(-alpha d), the positive root of T = (1 - rho)^2 x / (1 - rho^2 x^2). Equivalent to the
// reference's logarithm of (R - rho) / (rho T), but without 0 / 0 at rho = 0.
double straight_passage(double t, double rho) {
  double const b = square(1.0 - rho);
  return std::min(1.0, 2.0 * t / (b + std::hypot(b, 2.0 * rho * t)));
}

// Squared; 1 if both are 0, for grazing light on glass of index 1.
double fresnel(double difference, double sum) { return sum > 0.0 ? square(difference / sum) : 1.0; }

}  // namespace

double normalised(Quartic const& curve, double cosine, double at_grazing) {
  double const ten = std::cos(std::numbers::pi / 18.0);
  double const eighty = std::sin(std::numbers::pi / 18.0);
  double const to_normal = std::max(0.0, (cosine - ten) / (1.0 - ten));
  double const to_grazing = std::max(0.0, 1.0 - cosine / eighty);
  return polynomial(curve, cosine) + square(to_normal) * (1.0 - polynomial(curve, 1.0)) +
         square(to_grazing) * (at_grazing - polynomial(curve, 0.0));
}

Pane::Pane(GlassLayer const& layer) : normal_(layer) {
  if (layer.transmittance <= 0.0) return;
  double const front = interface_reflectivity(layer.transmittance, layer.front_reflectance);
  double const back = interface_reflectivity(layer.transmittance, layer.back_reflectance);
  constexpr double alike = 0.001;
  if (front == back || std::abs(front - back) < alike * (front + back)) {
    double const root = std::sqrt(front);
    kind_ = Uncoated{(1.0 + root) / (1.0 - root), straight_passage(layer.transmittance, front)};
  } else if (layer.transmittance > clear_above) {
    kind_ = Coated{&clear_transmittance, &clear_both};
  } else {
    kind_ = Coated{&bronze_transmittance, &bronze_both};
  }
}

PaneProperties Pane::at(double cosine) const {
  return std::visit([&](auto const& kind) { return properties(kind, cosine); }, kind_);
}

// "Angular Properties for Uncoated Glass".
PaneProperties Pane::properties(Uncoated const& glass, double cosine) const {
  double const n = glass.index;
  double const inside = std::sqrt(std::max(0.0, 1.0 - (1.0 - square(cosine)) / square(n)));
  double const passage = std::pow(glass.passage, 1.0 / inside);
  double transmittance = 0.0;
  double reflectance = 0.0;
  for (double const rho : {fresnel(n * cosine - inside, n * cosine + inside),
                           fresnel(n * inside - cosine, n * inside + cosine)}) {
    double const t = rho < 1.0 ? square(1.0 - rho) * passage / (1.0 - square(rho * passage)) : 0.0;
    transmittance += 0.5 * t;
    reflectance += 0.5 * rho * (1.0 + t * passage);
  }
  return {transmittance, reflectance, reflectance};
}

// "Angular Properties for Coated Glass".
PaneProperties Pane::properties(Coated const& glass, double cosine) const {
  double const t = normalised(*glass.transmittance, cosine, 0.0);
  double const r = normalised(*glass.reflectance, cosine, 1.0) - t;
  double const transmittance = std::clamp(normal_.transmittance * t, 0.0, 1.0);
  auto const reflectance = [&](double at_normal) {
    return std::clamp(std::lerp(at_normal, 1.0, r), 0.0, 1.0 - transmittance);
  };
  return {transmittance, reflectance(normal_.front_reflectance),
          reflectance(normal_.back_reflectance)};
}

PaneProperties Pane::properties(Opaque /*glass*/, double /*cosine*/) const {
  return {0.0, normal_.front_reflectance, normal_.back_reflectance};
}

}  // namespace gpu_shading
