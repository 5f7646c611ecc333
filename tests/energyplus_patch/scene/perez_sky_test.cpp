#include "scene/perez_sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "gpu_shading/sun_direction.h"
#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;

double product(std::vector<double> const& a, std::vector<double> const& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// Parameters a to e of the model as Radiance's gendaylit 5.4 prints them for the weather (-W): one
// sky of each bin of clearness, and one whose brightness is limited.
struct Sky {
  SkyWeather weather;
  double a, b, c, d, e;

  double radiance(glm::dvec3 const& direction) const {
    double const cosine = std::clamp(glm::dot(direction, weather.towards_sun), -1.0, 1.0);
    return std::max((1.0 + a * std::exp(b / direction.z)) *
                        (1.0 + c * std::exp(d * std::acos(cosine)) + e * cosine * cosine),
                    0.0);
  }
};

std::vector<Sky> const skies{
    {{{-0.654330, -0.717103, 0.240034}, 0, 60, 355},
     0.631721,
     -0.573140,
     0.749899,
     -0.579233,
     0.000201},
    {{{-0.047112, -0.712940, 0.699641}, 60, 300, 278},
     -1.119540,
     -1.173267,
     9.104378,
     -2.515054,
     0.140510},
    {{{0.731700, -0.441162, 0.519608}, 150, 220, 80},
     -1.078563,
     -0.916513,
     10.707110,
     -3.061720,
     0.102094},
    {{{0.500642, -0.781431, 0.372455}, 300, 120, 15},
     -1.208595,
     -0.594155,
     11.504782,
     -3.209779,
     0.045280},
    {{{-0.867997, -0.257434, 0.424628}, 700, 200, 253},
     -0.957704,
     -0.900392,
     10.951507,
     -3.030085,
     0.016187},
    {{{-0.481771, -0.498873, 0.720432}, 600, 200, 92},
     -0.874511,
     -0.376808,
     12.958802,
     -3.456610,
     0.226488},
    {{{0.888302, 0.159471, 0.430683}, 700, 60, 172},
     -0.983972,
     -0.202555,
     13.277376,
     -3.900237,
     0.536372},
    {{{0.008496, -0.280458, 0.959829}, 900, 100, 172},
     -1.000205,
     -0.230810,
     24.548020,
     -6.051057,
     1.476008},
    {{{-0.910623, 0.377181, 0.168823}, 20, 12, 172},
     -1.268980,
     -0.545969,
     8.617388,
     -2.817453,
     0.136280},
};

TEST(PerezSky, RadiancesOfPatchesAreThoseOfGendaylit) {
  constexpr int per_side = 40;
  for (auto const& sky : skies) {
    std::vector<double> expected;
    double horizontal = 0.0;
    for (auto const& centre : sky_patches()) {
      double const low = std::sin(centre.altitude - sky_step / 2.0);
      double const high = std::sin(centre.altitude + sky_step / 2.0);
      double sum = 0.0;
      for (int i = 0; i < per_side * per_side; ++i) {
        double const across = (i % per_side + 0.5) / per_side;
        double const up = (std::floor(1.0 * i / per_side) + 0.5) / per_side;
        auto const direction = to_vector(
            {centre.azimuth + (across - 0.5) * sky_step, std::asin(low + up * (high - low))});
        sum += sky.radiance(direction) / per_side / per_side;
      }
      expected.push_back(sum);
      // The integral of the sine of altitude over the patch.
      horizontal += sum * sky_step * (high * high - low * low) / 2.0;
    }
    auto const found = perez_radiances(sky.weather);
    ASSERT_EQ(found.size(), expected.size());
    double worst = 0.0;
    double mean = 0.0;
    for (std::size_t patch = 0; patch < found.size(); ++patch) {
      double const difference = std::abs(found[patch] / (expected[patch] / horizontal) - 1.0);
      worst = std::max(worst, difference);
      mean += difference / static_cast<double>(found.size());
    }
    // There are 16 directions in a patch, also where the sun is.
    EXPECT_LT(worst, 0.01) << sky.weather.beam << " and " << sky.weather.diffuse << " W/m2";
    EXPECT_LT(mean, 0.002) << sky.weather.beam << " and " << sky.weather.diffuse << " W/m2";
  }
}

TEST(PerezSky, LevelPlaneReceivesTheHorizontalIrradiance) {
  auto const up = patch_projections({0.0, 0.0, 1.0});
  for (auto const& sky : skies) EXPECT_NEAR(product(perez_radiances(sky.weather), up), 1.0, 1e-12);
}

// A plane sees (1 + cos tilt) / 2 of an even sky.
TEST(PerezSky, EvenSkyIsSeenByItsViewFactor) {
  for (double const tilt : {0.0, 30.0, 90.0, 150.0}) {
    double const angle = tilt * pi / 180.0;
    auto const projections = patch_projections({std::sin(angle), 0.0, std::cos(angle)});
    double const sum = std::accumulate(projections.begin(), projections.end(), 0.0);
    EXPECT_NEAR(sum / pi, (1.0 + std::cos(angle)) / 2.0, 1e-3) << tilt;
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus
