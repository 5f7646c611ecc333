// Louvres and fins at equal distances against their exact sunlit fraction: at the numbers at which
// their edges may meet the rows and columns of samples in step. tests/bench/aliasing takes more of
// them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "support/regular_shades.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

TEST(Aliasing, OfLouvresAndFinsIsBelowTheTargetAccuracy) {
  constexpr double target = 1e-3;
  std::vector<SunDirection> const suns = spread_suns(12);
  std::vector<double> errors;
  double worst_mean = 0.0;
  for (bool const upright : {false, true}) {
    for (int const count : blade_counts(20, 2000, 1.2, true)) {
      RegularShades const shades{count, upright};
      RendererOptions options;
      options.error = target;
      options.device = on_cpu;
      Renderer renderer(shades.scene(), options);
      double mean = 0.0;
      for (SunDirection const sun : suns) {
        double const cosine = -std::cos(sun.azimuth) * std::cos(sun.altitude);
        double const whole = shades.width() * shades.height() * cosine;
        double const got = sunlit(renderer, sun, 0).projected_area / whole;
        errors.push_back(std::abs(got - shades.sunlit_fraction(sun)));
        mean += errors.back() / static_cast<double>(suns.size());
      }
      worst_mean = std::max(worst_mean, mean);
    }
  }
  std::sort(errors.begin(), errors.end());
  double const most = errors.back();
  double const ninety_ninth = errors[errors.size() * 99 / 100];
  std::printf("%zu views: 99th percentile %.1e, most %.1e, worst mean of a scene %.1e\n",
              errors.size(), ninety_ninth, most, worst_mean);
  // Before a hundred louvres or so, of which the lattice's rows meet one each.
  EXPECT_LT(most, 3.0 * target);
  EXPECT_LT(worst_mean, target);
  EXPECT_LT(ninety_ninth, 0.7 * target);
}

}  // namespace
}  // namespace gpu_shading
