// Edges of every slope before a receiver, by samples and without, against exact polygons.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "gpu_shading/renderer.h"
#include "support/exact.h"
#include "support/random_scene.h"
#include "support/shapes.h"
#include "support/sloped_shades.h"

namespace gpu_shading {
namespace {

using Shade = SlopedShades::Shade;
using Beam = SlopedShades::Beam;

struct Slopes {
  double target;
  int pitches;  // between 0 and 90 degrees
  int suns;
  bool samples_only;
  std::vector<Shade> shades;
  std::vector<Beam> beams;
};

// At each pitch another receiver, shade and beam.
SlopeErrors errors_of(Slopes const& slopes) {
  std::vector<SunDirection> const suns = suns_over_edges(slopes.suns);
  std::size_t const shades = slopes.shades.size();
  SlopeErrors errors;
  for (int i = 1; i < slopes.pitches; ++i) {
    auto const turn = static_cast<std::size_t>(i);
    SlopedShades const sloped{
        SlopedShades::receivers.at(turn % 6), slopes.shades.at(turn / 6 % shades),
        slopes.beams.at(turn / (6 * shades) % slopes.beams.size()), 90.0 * i / slopes.pitches};
    errors.add(sloped, suns, slopes.target, slopes.samples_only);
  }
  std::printf("%zu views: most %.1e, beyond %g: %.2f %%\n", errors.count(), errors.most(),
              slopes.target, 100.0 * errors.beyond(slopes.target));
  return errors;
}

std::vector<Shade> const all_shades{Shade::edge, Shade::gable, Shade::slats};
std::vector<Shade> const few_edges{Shade::edge, Shade::gable};
std::vector<Beam> const without_screens{Beam::opaque, Beam::glass, Beam::scheduled};

TEST(Slopes, NoneIsInStepWithTheSamples) {
  SlopeErrors const errors = errors_of({1e-3, 900, 4, true, all_shades, without_screens});
  EXPECT_LE(errors.beyond(1e-3), 0.01);
  EXPECT_LE(errors.most(), 3e-3);
}

TEST(Slopes, NoneIsInStepWithTheSamplesOfFineTiles) {
  SlopeErrors const errors = errors_of({1e-4, 90, 2, true, all_shades, without_screens});
  EXPECT_LE(errors.beyond(1e-4), 0.01);
  EXPECT_LE(errors.most(), 3e-4);
}

// Perforated sheets whose holes are not drawn dim pixels, in place of rows of samples.
TEST(Slopes, OfScreensAreWithinTheTarget) {
  SlopeErrors const errors = errors_of({1e-3, 900, 4, false, few_edges, {Beam::screen}});
  EXPECT_LE(errors.beyond(1e-3), 0.01);
  EXPECT_LE(errors.most(), 3e-3);
}

// Without an option that asks for samples.
TEST(Slopes, OfFewEdgesAreExact) {
  SlopeErrors const errors = errors_of({1e-3, 900, 4, false, few_edges, without_screens});
  EXPECT_GT(errors.count(), 3000U);
  EXPECT_LE(errors.most(), 1e-7);
}

// A gable at the golden slope of a window of 3 x 1.5 m, the slope that samples were in step with.
TEST(Slopes, TheGoldenSlopeIsAsGoodAsOthers) {
  std::vector<SunDirection> const suns = suns_over_edges(100);
  for (double const pitch : {17.17, 17.4, 38.97}) {
    for (auto const beam : SlopedShades::beams) {
      SlopeErrors errors;
      errors.add({SlopedShades::Receiver::wide, SlopedShades::Shade::gable, beam, pitch}, suns,
                 1e-3, true);
      EXPECT_LE(errors.beyond(1e-3), 0.01) << pitch;
      EXPECT_LE(errors.most(), 3e-3) << pitch;
    }
  }
}

TEST(Slopes, OfRandomPolygonsAreExactWhereFew) {
  for (std::uint32_t seed = 1000; seed < 2000; ++seed) {
    RandomScene const random = random_scene(seed);
    RendererOptions options;
    options.device = on_cpu;
    options.error = 1e-4;
    Renderer renderer(random.scene, options);
    double const whole = exact::projected_area(random.scene, random.sun, 0);
    double const lit = exact::projected_sunlit_area(random.scene, random.sun, 0);
    EXPECT_NEAR(sunlit(renderer, random.sun, 0).projected_area, lit, 1e-4 * whole) << seed;
  }
}

// A wall at right angles to the windows of another, all edges along the axes.
TEST(Slopes, OfOneWallBesideAWindowIsWithinTheTarget) {
  for (bool const samples_only : {false, true}) {
    double most = 0.0;
    int beyond = 0;
    constexpr int windows = 400;
    for (int i = 0; i < windows; ++i) {
      // Its end throws the edge of the shadow across the window, and mostly its top as well.
      double const length = 0.42 + 1.16 * i / windows;
      double const height = 1.2 + 1.6 * std::fmod(i / std::numbers::phi, 1.0);
      Scene scene;
      scene.add({"window", parallelogram({0, 0.69, 1}, {0, 1.95, 0}, {0, 0, 1.215})});
      scene.add({"wall", parallelogram({0, 0, 0}, {length, 0, 0}, {0, 0, height})});
      RendererOptions options;
      options.device = on_cpu;
      options.samples_only = samples_only;
      Renderer renderer(scene, options);
      SunDirection const sun = sun_at(149.3, 19.4);
      double const whole = exact::projected_area(scene, sun, 0);
      double const lit = exact::projected_sunlit_area(scene, sun, 0);
      double const error = std::abs(sunlit(renderer, sun, 0).projected_area - lit) / whole;
      most = std::max(most, error);
      if (error > 1e-3) ++beyond;
    }
    std::printf("%s: most %.1e, beyond the target %d of %d\n", samples_only ? "samples" : "default",
                most, beyond, windows);
    EXPECT_LE(beyond, windows / 100);
    EXPECT_LE(most, samples_only ? 3e-3 : 1e-7);
  }
}

}  // namespace
}  // namespace gpu_shading
