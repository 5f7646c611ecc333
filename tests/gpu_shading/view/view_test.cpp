#include "view/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "gpu_shading/sun_direction.h"
#include "scene/casters.h"
#include "support/random_scene.h"

namespace gpu_shading {
namespace {

glm::dvec2 place(View const& view, glm::dvec3 const& point) {
  glm::dvec4 const p(point - view.origin, 1.0);
  return {glm::dot(view.x, p), glm::dot(view.y, p)};
}

TEST(View, PointsOnOneRayOfTheSunFallOnOnePlace) {
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    RandomScene const random = random_scene(seed);
    Ring const& outline = random.scene[0].polygon.outline;
    PlaneFrame const frame = *plane_frame(random.scene[0].polygon);
    TileMap const map = fit_tile(frame, outline, 512);
    glm::dvec3 const towards_sun = to_vector(random.sun);
    View const view = view_in_front(frame, map, towards_sun);
    for (glm::dvec3 const& vertex : outline) {
      glm::dvec2 const own = map(frame, vertex);
      EXPECT_LT(glm::distance(place(view, vertex), own), 1e-9);
      EXPECT_LT(glm::distance(place(view, vertex + 7.0 * towards_sun), own), 1e-9);
    }
  }
}

TEST(View, EveryReceiverFillsItsTileButForAPixel) {
  Polygon const reveal{{{0, 0, 0}, {30, 0, 0}, {30, 0.05, 0}, {0, 0.05, 0}}, {}};
  PlaneFrame const frame = *plane_frame(reveal);
  TileMap const map = fit_tile(frame, reveal.outline, 512);
  glm::dvec2 low(1.0);
  glm::dvec2 high(-1.0);
  for (glm::dvec3 const& vertex : reveal.outline) {
    low = glm::min(low, map(frame, vertex));
    high = glm::max(high, map(frame, vertex));
  }
  double const edge = 1.0 - 2.0 / 512;
  EXPECT_LT(glm::distance(low, glm::dvec2(-edge)), 1e-12);
  EXPECT_LT(glm::distance(high, glm::dvec2(edge)), 1e-12);
  // A turned square covers 1 / (cos + sin)^2 = 0.53 of the tile.
  double const pixels = area(reveal) / map.pixel_area(512);
  EXPECT_NEAR(pixels / (512.0 * 512.0), 0.53, 0.01);
}

TEST(View, EdgesCrossThePixelLatticeAtTheGoldenSlope) {
  Polygon const square{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {}};
  PlaneFrame const frame = *plane_frame(square);
  TileMap const map = fit_tile(frame, square.outline, 512);
  glm::dvec2 const edge = map(frame, {2, 0, 0}) - map(frame, {0, 0, 0});
  EXPECT_NEAR(edge.y / edge.x, (std::sqrt(5.0) - 1.0) / 2.0, 1e-12);
}

TEST(View, AStretchedTileHoldsTheReceiverAndNearlyAsManyOfItsPixels) {
  Polygon const square{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {}};
  PlaneFrame const frame = *plane_frame(square);
  double const pixel = fit_tile(frame, square.outline, 512).pixel_area(512);
  for (double const stretch : {0.9, 0.97, 1.04, 1.1}) {
    TileMap const map = fit_tile(frame, square.outline, 512, {.stretch = stretch});
    glm::dvec2 const u = map(frame, {2, 0, 0}) - map(frame, {0, 0, 0});
    glm::dvec2 const v = map(frame, {0, 2, 0}) - map(frame, {0, 0, 0});
    EXPECT_NEAR(glm::length(u) / glm::length(v), stretch * stretch, 1e-9);
    EXPECT_NEAR(glm::dot(u, v), 0.0, 1e-12);
    for (glm::dvec3 const& vertex : square.outline) {
      glm::dvec2 const place = glm::abs(map(frame, vertex));
      EXPECT_LE(std::max(place.x, place.y), 1.0 - 2.0 / 512 + 1e-12);
    }
    EXPECT_NEAR(map.pixel_area(512) / pixel, 1.03, 0.04);
  }
}

TEST(View, CutsAtThePlaneAndBehindItAtTheClearance) {
  Polygon const square{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {}};
  PlaneFrame const frame = *plane_frame(square);
  TileMap const map = fit_tile(frame, square.outline, 512);
  auto const kept = [](View const& view, glm::dvec3 const& point) {
    return glm::dot(view.cut, glm::dvec4(point - view.origin, 1.0)) >= 0.0;
  };
  View const front = view_in_front(frame, map, {0, 0, 1});
  EXPECT_TRUE(kept(front, {1, 1, 1e-12}));
  EXPECT_FALSE(kept(front, {1, 1, -1e-12}));
  View const behind = view_behind(frame, map, {0, 0, 1}, 3.0);
  EXPECT_TRUE(kept(behind, {1, 1, -1.1 * clearance}));
  EXPECT_FALSE(kept(behind, {1, 1, -0.9 * clearance}));
  EXPECT_NEAR(glm::dot(behind.z, glm::dvec4(glm::dvec3(1, 1, -3) - behind.origin, 1.0)), 1.0,
              1e-12);
}

}  // namespace
}  // namespace gpu_shading
