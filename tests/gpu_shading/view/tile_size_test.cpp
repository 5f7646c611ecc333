#include "view/tile_size.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gpu_shading/sun_direction.h"
#include "scene/casters.h"

namespace gpu_shading {
namespace {

TEST(TileSize, FollowsTheErrorAndTheDetailBetweenItsLimits) {
  TileSize const size = TileSize::for_error(1e-3, 16384);
  EXPECT_EQ(size.side(0.0, 0.0), 64);
  EXPECT_EQ(size.side(0.0, 1.0), 128);   // (1 / 1e-3)^(2/3) = 100
  EXPECT_EQ(size.side(0.0, 16.0), 256);  // 252
  EXPECT_EQ(size.side(9.0, 0.0), 192);   // sqrt(18.3 / 1e-3) = 135
  EXPECT_EQ(size.side(1e6, 1e6), 512);
  for (int step = 0; step < 53; ++step) {
    double const edges = 0.1 * std::pow(1.3, step);
    EXPECT_GE(size.side(0.0, 1.3 * edges), size.side(0.0, edges));
    EXPECT_GE(size.side(1.3 * edges, 0.0), size.side(edges, 0.0));
    EXPECT_LE(TileSize::for_error(3e-3, 16384).side(0.0, edges), size.side(0.0, edges));
  }
  EXPECT_EQ(size.side(size.enough(), 0.0), 512);
  EXPECT_EQ(size.side(0.0, size.enough()), 512);
}

TEST(TileSize, LimitsFollowTheErrorUpToWhatTheDeviceCan) {
  EXPECT_EQ(TileSize::for_error(1e-2, 16384).least(), 16);  // 64 / 10^(2/3) = 13.8
  EXPECT_EQ(TileSize::for_error(1e-2, 16384).most(), 128);  // 110
  EXPECT_EQ(TileSize::for_error(1e-4, 16384).most(), 3072);
  EXPECT_EQ(TileSize::for_error(1e-5, 16384).most(), 4096);
  EXPECT_EQ(TileSize::for_error(1e-5, 2048).side(1e9, 1e9), 2048);
}

TEST(TileSize, BehindACrowdFollowsTheSizeOfItsCasters) {
  TileSize const coarse = TileSize::for_error(1e-2, 16384);
  TileSize const fine = TileSize::for_error(1e-3, 16384);
  // Rows miss most of what is much smaller: 0.5 x 2.58 sqrt(a / (1.6 rows h)) = 1e-2 for squares of
  // 1e-3 at 10 rows, fewer than for one large caster, and of 4e-3 at 41.
  EXPECT_EQ(coarse.side_behind_crowd(1e-6, 1e-3, 0.0), coarse.side(0.0, 1.0));
  EXPECT_EQ(coarse.side_behind_crowd(1.6e-5, 4e-3, 0.0), 48);
  // Within four times the maximum, and what the device can.
  EXPECT_EQ(fine.side_behind_crowd(1.0, 1e-3, 0.0), 2048);
  EXPECT_EQ(TileSize::for_error(1e-3, 700).side_behind_crowd(1.0, 1e-3, 0.0), 700);
  for (double size = 1e-4; size < 0.1; size *= 1.3) {
    EXPECT_LE(coarse.side_behind_crowd(size * size, size, 0.0),
              fine.side_behind_crowd(size * size, size, 0.0));
    EXPECT_LE(coarse.side_behind_crowd(size * size, size, 0.0),
              coarse.side_behind_crowd(size * size, 0.5 * size, 0.0));
  }
}

TEST(TileSize, FixedIsFixed) {
  EXPECT_EQ(TileSize::fixed(300).side(5.0, 7.0), 300);
  EXPECT_EQ(TileSize::fixed(300).side_with_screens(300), 300);
  EXPECT_EQ(TileSize::for_error(1e-3, 16384).side_with_screens(64), 256);
}

TEST(TileSize, BehindScreensFollowsTheErrorFarther) {
  EXPECT_EQ(TileSize::for_error(1e-5, 16384).side_with_screens(64), 6144);  // half of 11,031
  EXPECT_EQ(TileSize::for_error(1e-5, 4096).side_with_screens(64), 2048);
}

class DetailOfShadows : public testing::Test {
 protected:
  // In a window facing south, 4 m wide and 2 m high.
  Detail of(Polygon const& caster) const {
    Scene scene;
    scene.add({"window", {{{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {0, 0, 2}}, {}}});
    scene.add({"caster", caster});
    // From the south, 45 degrees up: what stands 1 m out throws its shadow 1 m down.
    std::vector<SurfaceId> const in_view{1};
    return Casters(scene).detail(in_view, *plane_frame(scene[0].polygon),
                                 {0.0, -std::sqrt(0.5), std::sqrt(0.5)}, 1e9);
  }
};

TEST_F(DetailOfShadows, AnOverhangHasOneEdgeAndItsEnds) {
  // One metre deep, its foot at the window's head: the shadow fills the upper half.
  Detail const wide = of({{{-1, -1, 2}, {5, -1, 2}, {5, 0, 2}, {-1, 0, 2}}, {}});
  EXPECT_NEAR(wide.along, 1.0, 0.01);
  EXPECT_NEAR(wide.across, 0.0, 1e-9);
  // As it is from 1 m to 3 m: half of the width, and two ends over half of the height.
  Detail const narrow = of({{{1, -1, 2.1}, {3, -1, 2.1}, {3, 0, 2.1}, {1, 0, 2.1}}, {}});
  EXPECT_NEAR(narrow.along, 0.5 + 2 * 0.45, 1e-9);
}

TEST_F(DetailOfShadows, SlantedEdgesAndHolesCount) {
  // A quarter of the window each, from its middle.
  Polygon const kite{{{2, -1, 1.5}, {3, -1, 2}, {2, -1, 2.5}, {1, -1, 2}}, {}};
  Detail const slanted = of(kite);
  EXPECT_NEAR(slanted.along, 0.0, 1e-9);
  EXPECT_NEAR(slanted.across, 4.0 * std::hypot(0.25, 0.25), 1e-9);
  // All around the window, but for a hole.
  Polygon wall{{{-9, -1, -9}, {9, -1, -9}, {9, -1, 9}, {-9, -1, 9}}, {kite.outline}};
  EXPECT_NEAR(of(wall).across, slanted.across, 1e-9);
  wall.holes.clear();
  EXPECT_EQ(of(wall).total(), 0.0);
}

}  // namespace
}  // namespace gpu_shading
