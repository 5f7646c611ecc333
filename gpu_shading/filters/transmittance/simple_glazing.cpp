// After the EnergyPlus Engineering Reference, "Window Calculation Module", "Simple Window Model",
// and D. Arasteh, C. Kohler & B. Griffith (2009), "Modeling windows in EnergyPlus with simple
// performance indices", LBNL-2804E.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>

#include "filters/transmittance/pane.h"
#include "gpu_shading/error.h"
#include "gpu_shading/transmittance.h"

namespace gpu_shading {
namespace {

// Step 7: transmittance over its value at normal incidence.
constexpr Quartic a{0.0, 3.36, -3.85, 1.49, 0.01};   // single, 3 mm clear
constexpr Quartic b{0.0, 2.83, -2.42, 0.04, 0.55};   // single, 3 mm bronze
constexpr Quartic c{0.0, 2.45, -1.58, -0.64, 0.77};  // single, 6 mm bronze
constexpr Quartic d{0.0, 2.85, -2.58, 0.40, 0.35};   // single, 3 mm coated
constexpr Quartic e{0.0, 1.51, 2.49, -5.87, 2.88};   // double, 3 mm clear, clear
constexpr Quartic f{0.0, 1.21, 3.14, -6.37, 3.03};   // double, 3 mm coated, clear
constexpr Quartic g{0.0, 1.09, 3.54, -6.84, 3.23};   // double, 3 mm tinted, clear
constexpr Quartic h{0.0, 0.98, 3.83, -7.13, 3.33};   // double, 6 mm coated, clear
constexpr Quartic i{0.0, 0.79, 3.93, -6.86, 3.15};   // double, 6 mm tinted, clear
constexpr Quartic j{0.0, 0.08, 6.02, -8.84, 3.74};   // triple, 3 mm coated, clear, coated

constexpr Quartic mean(std::initializer_list<Quartic> curves) {
  Quartic sum{};
  for (Quartic const& curve : curves) {
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] += curve[k] / static_cast<double>(curves.size());
    }
  }
  return sum;
}

constexpr Quartic fh = mean({f, h});
constexpr Quartic fghi = mean({f, g, h, i});
constexpr Quartic bdcd = mean({b, d, c, d});

double share(double x, double from, double to) {
  return std::clamp((x - from) / (to - from), 0.0, 1.0);
}

Quartic mix(Quartic const& from, Quartic const& to, double t) {
  Quartic mixed{};
  for (std::size_t k = 0; k < mixed.size(); ++k) mixed[k] = std::lerp(from[k], to[k], t);
  return mixed;
}

// The 28 bins of U and SHGC in step 7: three ranges of U in which the curve depends on SHGC alone
// and, between them, from 1.4195 to 1.7034 and from 3.4068 to 4.5424 W/(m2 K), a blend of both
// neighbours.
Quartic angular_curve(SimpleGlazing const& window) {
  double const shgc = window.shgc;
  Quartic const low = mix(j, e, share(shgc, 0.35, 0.45));
  Quartic const middle = mix(mix(fh, fghi, share(shgc, 0.25, 0.30)), e, share(shgc, 0.50, 0.55));
  Quartic const high = mix(mix(d, bdcd, share(shgc, 0.30, 0.45)), a, share(shgc, 0.60, 0.65));
  return mix(mix(low, middle, share(window.u_factor, 1.4195, 1.7034)), high,
             share(window.u_factor, 3.4068, 4.5424));
}

// Step 4.
double normal_transmittance(SimpleGlazing const& window) {
  double const s = window.shgc;
  double const low = s <= 0.15 ? 0.41040 * s : (0.085775 * s + 0.963954) * s - 0.084958;
  double const high = s < 0.7206 ? (0.939998 * s + 0.20332) * s : 1.30415 * s - 0.30515;
  return std::clamp(std::lerp(low, high, share(window.u_factor, 3.4, 4.5)), 0.0, 1.0);
}

// Step 1, in winter: of the layer between the air films, m2 K/W.
double resistance(double u) {
  double const inside =
      u < 5.85 ? 1.0 / (0.359073 * std::log(u) + 6.949915) : 1.0 / (1.788041 * u - 2.886625);
  double const outside = 1.0 / (0.025342 * u + 29.163853);
  return std::max(1.0 / u - inside - outside, 0.001);  // as EnergyPlus limits it
}

void check(SimpleGlazing const& window) {
  if (!(window.u_factor > 0.0 && window.u_factor <= 7.0)) {
    throw Error(fmt::format("U-factor is {:.9g} W/(m2 K), expected above 0 and at most 7",
                            window.u_factor));
  }
  if (!(window.shgc > 0.0 && window.shgc < 1.0)) {
    throw Error(fmt::format("SHGC is {:.9g}, expected between 0 and 1", window.shgc));
  }
}

}  // namespace

Transmittance Transmittance::glazing(SimpleGlazing const& window) {
  check(window);
  return Transmittance(
      [curve = angular_curve(window), normal = normal_transmittance(window)](double angle) {
        return normal * normalised(curve, std::cos(angle), 0.0);
      });
}

double normal_reflectance(SimpleGlazing const& window) {
  check(window);
  double const transmittance = normal_transmittance(window);
  double const absorbed_inwards = window.shgc - transmittance;
  // In summer.
  struct Films {
    double inside, outside;  // m2 K/W
  };
  double const x = absorbed_inwards;
  Films const low{1.0 / (((199.8208128 * x - 90.639733) * x + 19.737055) * x + 6.766575),
                  1.0 / (5.763355 * x + 20.541528)};
  Films const high{1.0 / (((29.436546 * x - 21.943415) * x + 9.945872) * x + 7.426151),
                   1.0 / (2.225824 * x + 20.57708)};
  double const u = window.u_factor;
  double const t = share(u, 3.4, 4.5);
  // Between both ranges EnergyPlus leads away from `high`.
  double const towards = t < 1.0 ? -t : 1.0;
  double const inside = std::lerp(low.inside, high.inside, towards);
  double const outside = std::lerp(low.outside, high.outside, towards);
  double const layer = resistance(u);
  double const inward = (outside + 0.5 * layer) / (outside + layer + inside);
  return std::clamp(1.0 - transmittance - absorbed_inwards / inward, 0.0, 1.0);
}

}  // namespace gpu_shading
