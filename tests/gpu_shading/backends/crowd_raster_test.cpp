#include "backends/cpu/crowd_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "backends/cpu/coverage.h"
#include "backends/cpu/crowd_rays.h"
#include "geometry/triangulation.h"
#include "support/crowds.h"
#include "support/random_scene.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

void expect_as_listed(Scene const& scene, char const* name) {
  SCOPED_TRACE(name);
  Casters const casters(scene);
  Coverage const coverage(triangulate_all(scene));
  CrowdRaster const crowd(scene, casters, coverage.pieces());
  PlaneFrame const frame = *plane_frame(scene[0].polygon);
  int partly_lit = 0;
  for (int i = 0; i < 12; ++i) {
    glm::dvec3 const towards_sun = to_vector(sun_at(100 + 14 * i, 4 + 6 * i));
    if (glm::dot(frame.normal, towards_sun) <= 0.0) continue;
    std::vector<SurfaceId> const listed = casters.in_view(scene, 0, frame, towards_sun).casters;
    for (int const side : {16, 100, 512}) {
      Tile const tile = make_tile(scene[0].polygon, frame, side, 4096);
      View const view = view_in_front(frame, tile.map, towards_sun);
      CastersInView in_view{listed, {}, {}};
      double const expected = coverage.sums(tile, view, in_view, Samples::fine, 1).unscheduled;
      in_view.crowd = &crowd;
      in_view.question = {0, towards_sun};
      for (int const threads : {1, 3}) {
        EXPECT_EQ(coverage.sums(tile, view, in_view, Samples::fine, threads).unscheduled, expected)
            << "direction " << i << ", side " << side;
      }
      partly_lit += expected > 0.0 && expected < static_cast<double>(tile.counted_pixels) ? 1 : 0;
    }
  }
  EXPECT_GT(partly_lit, 10);
}

TEST(CrowdRaster, CoversTheSamplesThatListedCastersCover) {
  expect_as_listed(triangle_soup(400, 3), "triangles");
  Scene scene = mixed_crowd(700);
  expect_as_listed(scene, "mixed");
  scene.set_rule(thirds(scene));
  expect_as_listed(scene, "with a rule");
  expect_as_listed(mixed_crowd(5), "few");
}

std::uint64_t differing(PixelMask const& a, PixelMask const& b) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.words().size(); ++i) {
    count += static_cast<std::uint64_t>(std::popcount(a.words()[i] ^ b.words()[i]));
  }
  return count;
}

TEST(CrowdRays, CoverTheSamplesThatTheRasterCovers) {
  Scene scene = mixed_crowd(700);
  scene.set_rule(thirds(scene));
  Casters const casters(scene);
  SurfacePieces const pieces(triangulate_all(scene));
  CrowdRaster const raster(scene, casters, pieces);
  CrowdRays const rays(scene, casters);
  PlaneFrame const frame = *plane_frame(scene[0].polygon);
  Tile const tile = make_tile(scene[0].polygon, frame, 128, 4096);
  TileGrid const grid = pixels_of(tile);
  for (int i = 0; i < 12; ++i) {
    glm::dvec3 const towards_sun = to_vector(sun_at(100 + 14 * i, 4 + 6 * i));
    if (glm::dot(frame.normal, towards_sun) <= 0.0) continue;
    View const pixels = in_pixels(view_in_front(frame, tile.map, towards_sun), grid);
    PixelMask expected;
    expected.start(grid.columns(), 0, grid.rows);
    light(expected, tile, grid);
    PixelMask found = expected;
    std::uint64_t const own = expected.lit();
    raster.darken(expected, grid.side(), pixels, {0, towards_sun}, 1);
    rays.darken(found, pixels, {0, towards_sun});
    EXPECT_LT(expected.lit(), own);
    // Spans are in single precision.
    EXPECT_LE(differing(expected, found), 1U) << "direction " << i;
  }
}

// Louvres wider than the window, which is lit above them where the sun is high.
double lit_behind_louvres(glm::dvec3 const& towards_sun) {
  double const slope = towards_sun.z / -towards_sun.y;
  double const covered = std::min(1.0, 0.5 * (0.4 + slope));
  return 1.0 - covered * (1.0 - std::min(1.0, 0.05 * slope));
}

TEST(RepeatingCrowd, MeetsTheTarget) {
  Scene const scene = fine_louvres(3000, 2.0);
  RendererOptions options;
  options.device = on_cpu;
  options.error = 1e-2;
  Renderer renderer(scene, options);
  std::vector<double> errors;
  for (int i = 0; i < 200; ++i) {
    SunDirection const sun = sun_at(105 + 0.75 * i, 5.0 + std::fmod(37.0 * i, 60.0));
    glm::dvec3 const towards_sun = to_vector(sun);
    double const whole = 6.0 * -towards_sun.y;
    double const lit = sunlit(renderer, sun, 0).projected_area / whole;
    errors.push_back(std::abs(lit - lit_behind_louvres(towards_sun)));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LE(errors[errors.size() * 99 / 100 - 1], options.error);
  // Fewer samples than louvres: a raster of them all is more accurate.
  EXPECT_GT(errors[errors.size() / 2], 0.05 * options.error);
}

TEST(CrowdInView, SamplesTheCastersInView) {
  Scene scene = mixed_crowd(20000);
  scene.set_rule(thirds(scene));
  Casters const casters(scene);
  PlaneFrame const frame = *plane_frame(scene[0].polygon);
  for (int i = 0; i < 10; ++i) {
    glm::dvec3 const towards_sun = to_vector(sun_at(110 + 14 * i, 5 + 5 * i));
    std::vector<SurfaceId> const all = casters.in_view(scene, 0, frame, towards_sun).casters;
    auto const crowd = casters.crowd_in_view(scene, 0, frame, towards_sun, all.size() / 3);
    ASSERT_TRUE(crowd) << i;
    EXPECT_TRUE(std::includes(all.begin(), all.end(), crowd->sample.begin(), crowd->sample.end()));
    EXPECT_NEAR(crowd->count(), static_cast<double>(all.size()),
                0.3 * static_cast<double>(all.size()));
    EXPECT_FALSE(casters.crowd_in_view(scene, 0, frame, towards_sun, 3 * all.size()));
  }
}

}  // namespace
}  // namespace gpu_shading
