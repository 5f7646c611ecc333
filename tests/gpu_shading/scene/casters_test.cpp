#include "scene/casters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <random>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/sun_direction.h"
#include "support/exact.h"
#include "support/random_scene.h"

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

std::vector<SurfaceId> in_view_of_first(Scene const& scene, SunDirection sun) {
  return Casters(scene).in_view(scene, 0, *plane_frame(scene[0].polygon), to_vector(sun)).casters;
}

constexpr SunDirection from_the_south{3.14159, 0.785};

TEST(CastersInView, OnlyWhatReachesClearlyBeforeThePlane) {
  Scene scene;
  scene.add({"window", window});
  SurfaceId const overhang = scene.add({"overhang", horizontal(0, -1, 2, 2, 1)});
  scene.add({"roof behind", horizontal(0, 0, 3, 2, 5)});
  scene.add({"in the plane", {{{1, 0, 0}, {5, 0, 0}, {5, 0, 2}, {1, 0, 2}}, {}}});
  scene.add({"rounded", {{{1, -5e-5, 0}, {5, 5e-5, 0}, {5, 0, 2}, {1, 0, 2}}, {}}});
  SurfaceId const crossing = scene.add({"crossing", horizontal(0, -1, 1, 2, 9)});
  EXPECT_EQ(in_view_of_first(scene, from_the_south), (std::vector<SurfaceId>{overhang, crossing}));
}

TEST(CastersInView, FollowTheRuleAndLeaveOutDegenerateSurfaces) {
  Scene scene;
  scene.add({"window", window});
  SurfaceId const allowed = scene.add({"allowed", horizontal(0, -1, 2, 2, 1)});
  SurfaceId const barred = scene.add({"barred", horizontal(0, -1, 2, 2, 1)});
  scene.add({"degenerate", {{{0, -1, 0}, {1, -1, 0}}, {}}});
  ShadingRule rule{std::vector<ShadingRule::Role>(scene.size()), 1, {1}};
  for (SurfaceId id = 0; id < scene.size(); ++id) rule.roles[id].wall = id;
  rule.roles[barred].shades = ShadingRule::Shades::own_wall;
  scene.set_rule(rule);
  EXPECT_EQ(in_view_of_first(scene, from_the_south), std::vector<SurfaceId>{allowed});
}

TEST(CastersInView, FollowTheSun) {
  Scene scene;
  scene.add({"window", window});
  SurfaceId const overhang = scene.add({"overhang", horizontal(0, -1, 2, 2, 1)});
  SurfaceId const to_the_east = scene.add({"fin", {{{9, -9, 0}, {9, 0, 0}, {9, 0, 9}}, {}}});
  // From the south, 45 degrees up: the overhang's shadow falls down to the middle.
  auto const noon = in_view_of_first(scene, from_the_south);
  EXPECT_TRUE(contains(noon, overhang));
  EXPECT_FALSE(contains(noon, to_the_east));
  // From the south-east, low: past the overhang's edge, through the fin.
  auto const morning = in_view_of_first(scene, {1.8, 0.1});
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
    auto const in_view = in_view_of_first(scene, random.sun);
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

// A screen's faces lie beside its polygon.
TEST(CastersInView, ReachAsFarAsTheirSheets) {
  for (double const thickness : {0.0, 0.2}) {
    Scene scene;
    scene.add({"window", window});
    Surface sheet{"sheet", horizontal(0, -1, 2.05, 2, 1)};
    sheet.filter.set(PerforatedSheet{std::make_shared<PerforatedScreen const>(
        HolePattern({.size = 0.005, .pitch = 0.008}), Sheet{.thickness = thickness})});
    scene.add(sheet);
    // The sun is a little below the polygon as seen from the window's upper edge.
    EXPECT_EQ(in_view_of_first(scene, {3.14159, 0.03}).size(), thickness > 0.0 ? 1U : 0U);
  }
}

TEST(Bvh, LooksAtFewBoxesOutside) {
  std::vector<Box> boxes(10000);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::size_t const row = i / 100;
    glm::dvec3 const corner(static_cast<double>(i % 100), static_cast<double>(row), 0.0);
    boxes[i].include(corner);
    boxes[i].include(corner + 0.5);
  }
  boxes[77] = Box();
  Bvh const tree(boxes);
  int looked = 0;
  std::vector<std::uint32_t> found;
  tree.search(
      [&](glm::dvec3 const& centre, glm::dvec3 const& reach) {
        ++looked;
        auto const low = centre - reach;
        auto const high = centre + reach;
        return low.x < 3.0 && high.x > 2.0 && low.y < 1.0 ? Containment::intersecting
                                                          : Containment::outside;
      },
      [&](std::uint32_t first, std::uint32_t count, Containment) {
        EXPECT_EQ(count, 1U);
        found.push_back(tree.order()[first]);
      });
  EXPECT_EQ(found, std::vector<std::uint32_t>{2});
  EXPECT_LT(looked, 100);
  std::uint32_t all = 0;
  tree.search([](glm::dvec3 const&, glm::dvec3 const&) { return Containment::intersecting; },
              [&](std::uint32_t, std::uint32_t count, Containment) { all += count; });
  EXPECT_EQ(all, 9999U);
}

TEST(Bvh, DoesNotLookIntoBoxesInside) {
  std::vector<Box> boxes(10000);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i].include(glm::dvec3(static_cast<double>(i)));
    boxes[i].include(glm::dvec3(static_cast<double>(i) + 0.5));
  }
  boxes[77] = Box();
  Bvh const tree(boxes);
  int looked = 0;
  std::vector<int> found(boxes.size(), 0);
  std::size_t crossed = 0;
  tree.search(
      [&](glm::dvec3 const& centre, glm::dvec3 const& reach) {
        ++looked;
        if (centre.x + reach.x < 50.25) return Containment::outside;
        return centre.x - reach.x > 50.25 ? Containment::inside : Containment::intersecting;
      },
      [&](std::uint32_t first, std::uint32_t count, Containment containment) {
        for (std::uint32_t i = first; i < first + count; ++i) ++found[tree.order()[i]];
        if (containment == Containment::intersecting) crossed = tree.order()[first];
      });
  EXPECT_LT(looked, 100);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], i >= 50 && i != 77) << i;
  EXPECT_EQ(crossed, 50U);
}

TEST(Bvh, OfEmptyBoxesFindsNothing) {
  Bvh const tree(std::vector<Box>(3));
  tree.search([](glm::dvec3 const&, glm::dvec3 const&) { return Containment::inside; },
              [](std::uint32_t, std::uint32_t, Containment) { ADD_FAILURE(); });
}

// However many there are, and wherever their boxes lie.
TEST(CastersInView, ComeInTheOrderOfTheirIds) {
  for (int const count : {3, 63, 64, 65, 1000}) {
    Scene scene;
    scene.add({"window", window});
    for (int i = 0; i < count; ++i) {
      double const x = 0.1 + 1.8 * (i * 7919 % count) / count;
      scene.add({"slat", horizontal(x, -0.5, 2, 0.01, 0.4)});
    }
    auto const found = in_view_of_first(scene, from_the_south);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], i + 1);
  }
}

// Whatever the direction within it, and nearly nothing else where it is small.
TEST(CastersInView, AreAmongThoseOfASector) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> tangent(-4.0, 4.0);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::size_t in_view = 0;
  std::size_t in_sector = 0;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    Scene const scene = seed % 2 == 0 ? random_scene(seed).scene : triangle_soup(60, seed);
    PlaneFrame const frame = plane_frame(scene[0].polygon).value();
    Casters const casters(scene);
    glm::dvec2 const low(tangent(engine), tangent(engine));
    glm::dvec2 const size = glm::dvec2(0.2) + glm::abs(low) * 0.2;
    auto const places = casters.in_sector(scene, 0, frame, {low, low + size});
    if (!places) continue;
    for (int i = 0; i < 20; ++i) {
      glm::dvec2 const at = low + size * glm::dvec2(share(engine), share(engine));
      glm::dvec3 const towards_sun = glm::normalize(frame.normal + at.x * frame.u + at.y * frame.v);
      auto const searched = casters.in_view(scene, 0, frame, towards_sun).casters;
      EXPECT_EQ(casters.in_view_of(*places, frame, towards_sun).casters, searched) << seed;
      in_view += searched.size();
      in_sector += places->size();
    }
  }
  EXPECT_GT(in_view, 5000U);
  EXPECT_LT(in_sector, 3 * in_view);
}

}  // namespace
}  // namespace gpu_shading
