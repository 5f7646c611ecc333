#include "scene/casters.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "exact.h"
#include "gpu_shading/sun_direction.h"
#include "random_scene.h"

namespace gpu_shading {
namespace {

bool contains(std::vector<SurfaceId> const& list, SurfaceId id) {
  return std::find(list.begin(), list.end(), id) != list.end();
}

// A window facing south, 2 x 2 m, its lower corner at the origin.
Polygon const window{{{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}}, {}};

Polygon horizontal(double x, double y, double z, double width, double depth) {
  return {{{x, y, z}, {x + width, y, z}, {x + width, y + depth, z}, {x, y + depth, z}}, {}};
}

std::vector<SurfaceId> in_front_of_first(Scene const& scene) {
  return Casters(scene).in_front(scene, 0, *plane_frame(scene[0].polygon));
}

TEST(CastersInFront, OnlyWhatReachesClearlyBeforeThePlane) {
  Scene scene;
  scene.add({"window", window});
  SurfaceId const overhang = scene.add({"overhang", horizontal(0, -1, 2, 2, 1)});
  scene.add({"roof behind", horizontal(0, 0, 3, 2, 5)});
  scene.add({"neighbour in the plane", {{{3, 0, 0}, {5, 0, 0}, {5, 0, 2}, {3, 0, 2}}, {}}});
  scene.add({"rounded", {{{3, -5e-5, 0}, {5, 5e-5, 0}, {5, 0, 2}, {3, 0, 2}}, {}}});
  SurfaceId const crossing = scene.add({"crossing", horizontal(0, -1, 1, 2, 9)});
  EXPECT_EQ(in_front_of_first(scene), (std::vector<SurfaceId>{overhang, crossing}));
}

TEST(CastersInFront, TheRuleIsAskedAndDegenerateSurfacesAreNot) {
  Scene scene;
  scene.add({"window", window});
  SurfaceId const allowed = scene.add({"allowed", horizontal(0, -1, 2, 2, 1)});
  SurfaceId const barred = scene.add({"barred", horizontal(0, -1, 2, 2, 1)});
  SurfaceId const degenerate = scene.add({"degenerate", {{{0, -1, 0}, {1, -1, 0}}, {}}});
  scene.set_rule([&](SurfaceId receiver, SurfaceId caster) {
    EXPECT_EQ(receiver, 0U);
    EXPECT_NE(caster, degenerate);
    return caster != barred;
  });
  EXPECT_EQ(in_front_of_first(scene), std::vector<SurfaceId>{allowed});
}

TEST(CastersInView, FollowTheSun) {
  Scene scene;
  scene.add({"window", window});
  SurfaceId const overhang = scene.add({"overhang", horizontal(0, -1, 2, 2, 1)});
  SurfaceId const to_the_east = scene.add({"fin", {{{9, -9, 0}, {9, 0, 0}, {9, 0, 9}}, {}}});
  Casters const casters(scene);
  PlaneFrame const frame = *plane_frame(window);
  std::vector<SurfaceId> const both{overhang, to_the_east};
  // From the south, 45 degrees up: the overhang's shadow falls down to the middle.
  auto const noon = casters.in_view(both, frame, to_vector({3.14159, 0.785}));
  EXPECT_TRUE(contains(noon, overhang));
  EXPECT_FALSE(contains(noon, to_the_east));
  // From the south-east, low: past the overhang's edge, through the fin.
  auto const morning = casters.in_view(both, frame, to_vector({1.8, 0.1}));
  EXPECT_TRUE(contains(morning, to_the_east));
}

// The property that culling must keep.
TEST(CastersInView, NeverLoseOneThatTouches) {
  int touching = 0;
  int kept = 0;
  int all = 0;
  for (std::uint32_t seed = 1; seed <= 1000; ++seed) {
    RandomScene const random = random_scene(seed);
    Scene const& scene = random.scene;
    Casters const casters(scene);
    PlaneFrame const frame = *plane_frame(scene[0].polygon);
    auto const in_front = casters.in_front(scene, 0, frame);
    auto const in_view = casters.in_view(in_front, frame, to_vector(random.sun));
    for (SurfaceId id = 1; id < scene.size(); ++id) {
      ++all;
      if (contains(in_view, id)) ++kept;
      // Less may lie within the clearance from the plane.
      constexpr double strip = 1e-3;
      if (exact::shadow_area(scene, random.sun, 0, id) <= strip) continue;
      ++touching;
      EXPECT_TRUE(contains(in_view, id)) << "seed " << seed << ", caster " << id;
    }
  }
  EXPECT_GT(touching, 1000);
  // And culling does cull: what does not touch is mostly gone.
  EXPECT_LT(kept, all);
  EXPECT_LT(kept, touching * 1.15);
}

}  // namespace
}  // namespace gpu_shading
