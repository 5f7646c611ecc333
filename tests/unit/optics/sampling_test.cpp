#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "gpu_shading/transmittance.h"
#include "support/degree.h"
#include "support/refusal.h"

namespace gpu_shading {
namespace {

std::vector<Transmittance> models() {
  std::vector<GlassLayer> const clear(3, {0.775, 0.071, 0.071});
  std::span<GlassLayer const> const panes(clear);
  std::vector<GlassLayer> const coated{{0.6, 0.17, 0.22}, {0.775, 0.071, 0.071}};
  return {
      Transmittance::glazing(panes.first(1)),
      Transmittance::glazing(panes.first(2)),
      Transmittance::glazing(panes),
      Transmittance::glazing(coated),
      Transmittance::glazing(std::span(coated).first(1)),
      Transmittance::glazing(SimpleGlazing{2.0, 0.4}),
      Transmittance::glazing(SimpleGlazing{5.8, 0.8}),
      Transmittance::polynomial_in_degrees({0.8, -0.008}),
      Transmittance::polynomial_in_cosine({0.0, 0.5, 0.3}),
  };
}

// As a shader reads them.
double read(std::vector<float> const& samples, double cosine) {
  double const place = std::sqrt(1.0 - std::sqrt(cosine)) * static_cast<double>(samples.size() - 1);
  auto const below = std::min(static_cast<std::size_t>(place), samples.size() - 2);
  return std::lerp(static_cast<double>(samples[below]), static_cast<double>(samples[below + 1]),
                   place - static_cast<double>(below));
}

TEST(Samples, BeginAtNormalAndEndAtGrazingIncidence) {
  std::vector<float> const samples =
      sample(Transmittance::polynomial_in_degrees({0.8, -0.005}), 33);
  ASSERT_EQ(samples.size(), 33U);
  EXPECT_FLOAT_EQ(samples.front(), 0.8F);
  EXPECT_FLOAT_EQ(samples.back(), 0.35F);
}

TEST(Samples, AThousandAreWithinAHundredThousandth) {
  for (Transmittance const& model : models()) {
    std::vector<float> const samples = sample(model, 1025);
    EXPECT_LT(sampling_error(model, samples), 1e-5);
    for (int step = 0; step < 2500; ++step) {
      double const angle = 0.036 * step;
      EXPECT_NEAR(read(samples, std::cos(angle * degree)), model(angle * degree), 1e-5);
    }
  }
}

TEST(Samples, AreAsManyAsTheModelNeeds) {
  EXPECT_EQ(samples_within(Transmittance::constant(0.5), 1e-5), 2);
  for (Transmittance const& model : models()) {
    int const needed = samples_within(model, 1e-4);
    EXPECT_LE(needed, 257);
    EXPECT_LE(sampling_error(model, sample(model, needed)), 1e-4);
  }
  EXPECT_EQ(samples_within(Transmittance::polynomial_in_degrees({0.8, -0.008}), 0.0), 4097);
}

TEST(Samples, AreTwoAtLeast) {
  EXPECT_EQ(refusal_of([] { sample(Transmittance(), 1); }), "1 samples, expected 2 or more");
}

}  // namespace
}  // namespace gpu_shading
