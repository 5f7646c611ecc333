#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "support/exact.h"
#include "support/pixel_count.h"
#include "support/random_scene.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

double share_of_window(Scene const& scene, SunDirection sun, int resolution = 512) {
  Renderer renderer = renderer_of(scene, resolution);
  return sunlit(renderer, sun, 0).projected_area / exact::projected_area(scene, sun, 0);
}

TEST(Sunlit, NothingWhenTurnedAwayOrEdgeOn) {
  Scene scene;
  SurfaceId const wall = scene.add({"wall", south_facing(0, 0, 0, 4, 3)});
  SurfaceId const roof = scene.add({"roof", level(0, 0, 3, 4, 4)});
  Renderer renderer = renderer_of(scene);
  EXPECT_EQ(sunlit(renderer, sun_at(0, 30), wall).projected_area, 0.0);
  EXPECT_EQ(sunlit(renderer, sun_at(90, 30), wall).projected_area, 0.0);
  EXPECT_EQ(sunlit(renderer, sun_at(180, 0), roof).projected_area, 0.0);
  EXPECT_EQ(sunlit(renderer, sun_at(180, -20), roof).projected_area, 0.0);
}

TEST(Sunlit, NothingOfDegenerateAndEmptyPolygons) {
  Scene scene;
  std::vector<SurfaceId> const all{
      scene.add({"empty", {}}),
      scene.add({"line", {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}}}),
      scene.add({"two vertices", {{{0, 0, 0}, {1, 0, 0}}, {}}}),
      scene.add({"a point", {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {}}}),
  };
  Renderer renderer = renderer_of(scene);
  for (Sunlit const& answer : renderer.projected_sunlit_areas(sun_at(180, 45), all)) {
    EXPECT_EQ(answer.projected_area, 0.0);
  }
}

TEST(Sunlit, NoReceiversNoAnswers) {
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 4, 3)});
  Renderer renderer = renderer_of(scene);
  EXPECT_TRUE(renderer.projected_sunlit_areas(sun_at(180, 45), {}).empty());
  Renderer empty = renderer_of(Scene());
  EXPECT_TRUE(empty.projected_sunlit_areas(sun_at(180, 45), {}).empty());
}

TEST(Sunlit, AnUnknownSurfaceIsAnErrorThatNamesIt) {
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 4, 3)});
  Renderer renderer = renderer_of(scene);
  try {
    sunlit(renderer, sun_at(180, 45), 7);
    ADD_FAILURE();
  } catch (Error const& error) {
    EXPECT_NE(std::string(error.what()).find('7'), std::string::npos) << error.what();
  }
}

TEST(Sunlit, ExactWithNothingInView) {
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 4, 3)});
  scene.add({"far to the east", south_facing(100, -1, 0, 4, 3)});
  Renderer renderer = renderer_of(scene);
  SunDirection const sun = sun_at(200, 37);
  EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area,
              12.0 * std::cos(20 * degree) * std::cos(37 * degree), 1e-12);
  EXPECT_EQ(renderer.statistics().receivers_clear, 1U);
  EXPECT_EQ(renderer.statistics().receivers_drawn, 0U);
}

TEST(Sunlit, AllOrNothingUnderABigCaster) {
  Scene scene;
  scene.add({"table", level(0, 0, 0, 2, 2)});
  scene.add({"roof", level(-5, -5, 3, 12, 12)});
  Renderer renderer = renderer_of(scene);
  EXPECT_EQ(sunlit(renderer, sun_at(180, 80), 0).projected_area, 0.0);
  EXPECT_EQ(renderer.statistics().receivers_drawn, 1U);
  EXPECT_EQ(renderer.statistics().casters_drawn, 1U);
}

TEST(Sunlit, ZenithSun) {
  Scene scene;
  scene.add({"terrace", level(0, 0, 0, 4, 4)});
  scene.add({"canopy", level(-1, -1, 3, 2, 6)});
  EXPECT_NEAR(share_of_window(scene, {}), 0.75, 5e-4);
}

TEST(Sunlit, GrazingSunLosesLessThanTheCosine) {
  Scene scene;
  scene.add({"terrace", level(0, 0, 0, 4, 4)});
  scene.add({"parapet", parallelogram({0, 0, 0}, {4, 0, 0}, {0, 0, 0.01})});
  for (double const altitude : {0.1, 0.5, 2.0}) {
    SunDirection const sun = sun_at(180, altitude);
    Renderer renderer = renderer_of(scene);
    double const shadow = std::min(4.0, 0.01 / std::tan(altitude * degree));
    double const exact = 4.0 * (4.0 - shadow) * std::sin(altitude * degree);
    EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area, exact,
                1e-3 * 4.0 * std::sin(altitude * degree));
  }
}

TEST(Sunlit, CastersThatTouchThePlaneOrLieInItDoNotCast) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 2, 2)});
  scene.add({"the same again", south_facing(0, 0, 0, 2, 2)});
  scene.add({"frame over its edge", south_facing(-0.1, 0, 0, 0.3, 2)});
  scene.add({"ceiling behind", level(0, 0, 2, 2, 4)});
  scene.add({"partition behind", parallelogram({1, 0, 0}, {0, 4, 0}, {0, 0, 2})});
  Renderer renderer = renderer_of(scene);
  SunDirection const sun = sun_at(150, 40);
  EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area, exact::projected_area(scene, sun, 0), 1e-12);
}

// A slab through the window's plane: only its outer half is an overhang.
TEST(Sunlit, CasterThroughThePlaneCastsWithItsOuterPart) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 2, 2)});
  scene.add({"slab", level(-9, -0.5, 2, 20, 40)});
  double const shadow = 0.5 * std::tan(45 * degree);
  EXPECT_NEAR(share_of_window(scene, sun_at(180, 45)), 1.0 - shadow / 2.0, 5e-4);
}

TEST(Sunlit, SetBackWindowInItsReveal) {
  Scene scene;
  constexpr double back = 0.2;
  scene.add({"window", south_facing(1, back, 1, 1.2, 1.5)});
  SurfaceId const wall = scene.add({"wall", south_facing(0, 0, 0, 4, 3)});
  Scene whole;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Surface surface = scene[id];
    if (id == wall) surface.polygon.holes = {{{1, 0, 1}, {2.2, 0, 1}, {2.2, 0, 2.5}, {1, 0, 2.5}}};
    whole.add(surface);
  }
  whole.add({"head", level(1, 0, 2.5, 1.2, back)});
  whole.add({"sill", level(1, 0, 1, 1.2, back)});
  whole.add({"jamb", parallelogram({1, 0, 1}, {0, back, 0}, {0, 0, 1.5})});
  whole.add({"other jamb", parallelogram({2.2, 0, 1}, {0, back, 0}, {0, 0, 1.5})});
  for (double const g : {0.0, 30.0, 60.0}) {
    double const wide = 1.2 - back * std::tan(g * degree);
    double const tall = 1.5 - back * std::tan(40 * degree) / std::cos(g * degree);
    EXPECT_NEAR(share_of_window(whole, sun_at(180 + g, 40)), wide * tall / (1.2 * 1.5), 1e-3) << g;
  }
}

// The wall around the window: its hole neither casts nor receives.
TEST(Sunlit, AreaOfAWallIsNetOfItsWindow) {
  Scene scene;
  Polygon wall = south_facing(0, 0, 0, 4, 3);
  wall.holes = {{{1, 0, 1}, {3, 0, 1}, {3, 0, 2}, {1, 0, 2}}};
  scene.add({"wall", wall});
  // Its shadow ends at mid height, 1.5 m: half of the wall's net area by symmetry.
  scene.add({"overhang", level(-9, -1.5, 3, 22, 1.5)});
  Renderer renderer = renderer_of(scene);
  SunDirection const sun = sun_at(180, 45);
  EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area, 5.0 * std::cos(45 * degree), 10 * 5e-4);
}

TEST(Sunlit, TheRuleSaysWhoShadesWhom) {
  Scene scene;
  scene.add({"table", level(0, 0, 0, 2, 2)});
  scene.add({"roof", level(-5, -5, 3, 12, 12)});
  // The table shades the roof, in a zone that shades no other.
  scene.set_rule({{{0, 0}, {1, 1}}, 2, {1, 0, 1, 1}});
  EXPECT_NEAR(share_of_window(scene, sun_at(180, 80)), 1.0, 1e-12);
}

// What the golden slope of the lattice is for: edges along the receiver's own, many of them.
TEST(Sunlit, FiftySlatsAlongTheWindow) {
  Scene scene;
  constexpr int slats = 50;
  constexpr double pitch = 3.0 / slats;
  constexpr double depth = 0.02;
  scene.add({"window", south_facing(0, 0, 0, 3, 3)});
  for (int i = 0; i < slats; ++i) {
    scene.add({"slat", level(-9, -0.5 - depth, (i + 0.5) * pitch + 0.5, 21, depth)});
  }
  for (double const altitude : {20.0, 33.0, 45.0, 50.0}) {
    SunDirection const sun = sun_at(180, altitude);
    double const exact = exact::projected_sunlit_area(scene, sun, 0) / 9.0;
    Renderer renderer = renderer_of(scene);
    EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area / 9.0, exact, 1e-3) << altitude;
  }
}

// A reveal 5 cm deep and 30 m long, a shadow across one third of it.
TEST(Sunlit, LongThinReceiver) {
  Scene scene;
  scene.add({"sill", level(0, 0, 0, 30, 0.05)});
  scene.add({"wing", level(20, -1, 2, 15, 2)});
  EXPECT_NEAR(share_of_window(scene, {}), 2.0 / 3.0, 1e-3);
  Scene across;
  across.add({"sill", level(0, 0, 0, 30, 0.05)});
  across.add({"eaves", level(-1, 0.02, 2, 40, 1)});
  EXPECT_NEAR(share_of_window(across, {}), 0.4, 1e-3);
}

TEST(Sunlit, PixelCountAgreesWithTheRatio) {
  RandomScene const random = random_scene(3);
  PixelCount renderer(random.scene, {.device = {}, .resolution = 512, .samples_only = true});
  auto const [answered, counted] = renderer.areas(random.sun, 0);
  EXPECT_GT(answered, 0.0);
  EXPECT_NE(counted, answered);
  EXPECT_NEAR(counted / answered, 1.0, 2e-3);
}

TEST(Sunlit, SmallTilesStillAnswer) {
  Scene scene;
  scene.add({"terrace", level(0, 0, 0, 4, 4)});
  scene.add({"canopy", level(-1, -1, 3, 3, 6)});
  EXPECT_NEAR(share_of_window(scene, {}, 16), 0.5, 0.05);
  // No receiver is left with fewer than 16 pixels.
  EXPECT_NEAR(share_of_window(scene, {}, 1), 0.5, 0.1);
}

// What is left of a 3 x 3 m wall around a window of `opening` x `opening`, below an overhang.
Scene ring_of_wall(double opening) {
  Polygon wall = south_facing(0, 0, 0, 3, 3);
  double const at = 0.5 * (3 - opening);
  wall.holes = {south_facing(at, 0, at, opening, opening).outline};
  Scene scene;
  scene.add({"wall", wall});
  scene.add({"overhang", level(0.7, -0.8, 3, 1.9, 0.8)});
  return scene;
}

TEST(Sunlit, ThinRingOfWallAroundAWindow) {
  Scene const scene = ring_of_wall(2.9995);
  for (SunDirection const sun : {sun_at(180, 40), sun_at(160, 25), sun_at(215, 60)}) {
    double const exact =
        exact::projected_sunlit_area(scene, sun, 0) / exact::projected_area(scene, sun, 0);
    EXPECT_NEAR(share_of_window(scene, sun), exact, 2.2e-3);  // an NVIDIA H100: 2.1e-3
  }
}

// Where it has no pixels of its own, the bounding rectangle's.
TEST(Sunlit, NoReceiverIsTooThin) {
  for (double const opening : {2.999999, 2.9999999999}) {
    Scene const scene = ring_of_wall(opening);
    for (int const resolution : {1, 2, 64, 512}) {
      double const lit = share_of_window(scene, sun_at(180, 45), resolution);
      EXPECT_NEAR(lit, 1.0 - 1.9 * 0.8 / 9.0, resolution < 64 ? 0.1 : 2e-3);
    }
  }
  // A sliver across rows of pixels as wide as a hair.
  Scene scene;
  scene.add({"sliver", {{{0, 0, 0}, {3, 0, 3}, {3, 0, 3 - 1e-7}}, {}}});
  scene.add({"roof", level(-5, -5, 3, 12, 12)});
  Renderer renderer = renderer_of(scene);
  EXPECT_EQ(sunlit(renderer, sun_at(180, 89), 0).projected_area, 0.0);
}

TEST(Sunlit, TilesOfSeveralSidesInOneCall) {
  Scene scene = ring_of_wall(2.9995);
  scene.add({"wide wall", south_facing(0.2, 0, 0, 3, 3)});
  Renderer renderer = renderer_of(scene);
  SunDirection const sun = sun_at(170, 40);
  std::vector<SurfaceId> const both{0, 2};
  auto const answers = renderer.projected_sunlit_areas(sun, both);
  EXPECT_EQ(answers[0].projected_area, sunlit(renderer, sun, 0).projected_area);
  EXPECT_EQ(answers[1].projected_area, sunlit(renderer, sun, 2).projected_area);
  EXPECT_NEAR(answers[1].projected_area, exact::projected_sunlit_area(scene, sun, 2), 1e-3 * 9);
}

// A cube of 1 m over a terrace, its faces turned outwards.
std::vector<Polygon> cube() {
  return {level(0, 0, 2, 1, 1),
          parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}),
          south_facing(0, 0, 1, 1, 1),
          parallelogram({1, 1, 1}, {-1, 0, 0}, {0, 0, 1}),
          parallelogram({1, 0, 1}, {0, 1, 0}, {0, 0, 1}),
          parallelogram({0, 1, 1}, {0, -1, 0}, {0, 0, 1})};
}

Scene under_a_cube(Casting casting, std::vector<std::size_t> const& left_out = {}) {
  Scene scene;
  scene.add({"terrace", level(-4, -4, 0, 9, 9)});
  std::vector<Polygon> const faces = cube();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (std::find(left_out.begin(), left_out.end(), i) != left_out.end()) continue;
    scene.add({"face", faces[i], casting});
  }
  return scene;
}

std::vector<SunDirection> const around{sun_at(10, 35),  sun_at(75, 60),  sun_at(180, 45),
                                       sun_at(230, 50), sun_at(300, 40), {}};

TEST(Casting, ClosedBodyOfFacesTurnedAwayShadesLikeSheets) {
  Renderer sheets = renderer_of(under_a_cube(Casting::always));
  Renderer faces = renderer_of(under_a_cube(Casting::turned_away));
  for (SunDirection const sun : around) {
    double const exact = exact::projected_sunlit_area(under_a_cube(Casting::always), sun, 0);
    EXPECT_NEAR(sunlit(sheets, sun, 0).projected_area, exact, 1e-3 * 81);
    EXPECT_NEAR(sunlit(faces, sun, 0).projected_area, sunlit(sheets, sun, 0).projected_area,
                1e-4 * 81);
  }
  EXPECT_LT(faces.statistics().casters_drawn, sheets.statistics().casters_drawn);
}

TEST(Casting, OpenBodyLetsTheSunThroughItsLitFaces) {
  // Without its bottom, a roof in the sun and two lit walls cast nothing; the two walls turned away
  // do.
  Scene const open = under_a_cube(Casting::turned_away, {1});
  SunDirection const sun = sun_at(225, 45);
  Scene turned_away;
  turned_away.add(open[0]);
  for (std::size_t const face : {3U, 4U}) turned_away.add({"face", cube()[face]});
  Renderer renderer = renderer_of(open);
  EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area,
              exact::projected_sunlit_area(turned_away, sun, 0), 1e-3 * 81);
  // Right under the sun nothing is left.
  EXPECT_NEAR(sunlit(renderer, {}, 0).projected_area, 81.0, 1e-9);
  Scene roof = under_a_cube(Casting::turned_away, {1, 2, 3, 4, 5});
  EXPECT_NEAR(share_of_window(roof, sun), 1.0, 1e-12);
}

TEST(Casting, NeverOnlyReceives) {
  Scene const scene = under_a_cube(Casting::never);
  Renderer renderer = renderer_of(scene);
  SunDirection const sun = sun_at(225, 45);
  EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area, exact::projected_area(scene, sun, 0), 1e-9);
  EXPECT_EQ(renderer.statistics().receivers_clear, 1U);
  EXPECT_NEAR(sunlit(renderer, sun, 1).projected_area, std::sin(45 * degree), 1e-12);
}

// A ridge 30 km away, in triangles of kilometres, whose shadow's edge crosses a window at sunrise.
TEST(Sunlit, TerrainThirtyKilometresAway) {
  constexpr double away = 3e4;
  double const altitude = 2.0 * degree;
  double const ridge = away * std::tan(altitude) + 1.25;  // its shadow ends 1.25 m up the window
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 2, 2)});
  scene.add({"ridge", south_facing(-5e3, -away, -500, 1e4, ridge + 500)});
  Renderer renderer = renderer_of(scene);
  EXPECT_NEAR(sunlit(renderer, sun_at(180, 2), 0).projected_area / 4.0,
              0.75 / 2.0 * std::cos(altitude), 2e-3);
}

// Faces of kilometres through the receiver's plane, the sun grazing it.
TEST(Sunlit, HugeCasterThroughThePlaneAtGrazingSun) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 2, 2)});
  scene.add({"hillside", parallelogram({-0.7, -9e3, -9e3}, {0, 18e3, 0}, {0, 0, 9001})});
  for (double const g : {45.0, 80.0, 89.0, 89.9}) {
    SunDirection const sun = sun_at(180 + g, 0.5);
    double const cosine = std::cos(g * degree) * std::cos(0.5 * degree);
    double const exact = exact::projected_sunlit_area(scene, sun, 0) / 4.0;
    Renderer renderer = renderer_of(scene);
    // What is cut off before the plane lets a strip of at most 0.1 mm x tan(incidence) through.
    EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area / 4.0, exact, 2e-3 * cosine + 0.5e-4) << g;
  }
}

// A street: houses that shade each other, asked for in one call.
Scene street() {
  Scene scene;
  for (int house = 0; house < 30; ++house) {
    double const x = 7.0 * house;
    double const tall = 3.0 + house % 5;
    scene.add({"front", south_facing(x, 0, 0, 6, tall)});
    scene.add({"roof", level(x, 0, tall, 6, 8)});
    scene.add({"opposite", parallelogram({x + 6, -9, 0}, {-6, 0, 0}, {0, 0, 6 + house % 3})});
    scene.add({"side", parallelogram({x + 6, 0, 0}, {0, 8, 0}, {0, 0, tall})});
  }
  return scene;
}

std::vector<SurfaceId> all_of(Scene const& scene) {
  std::vector<SurfaceId> ids(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) ids[id] = id;
  return ids;
}

std::vector<double> areas(std::vector<Sunlit> const& answers) {
  std::vector<double> found;
  found.reserve(answers.size());
  for (Sunlit const& answer : answers) found.push_back(answer.projected_area);
  return found;
}

TEST(Sunlit, ManyReceiversInOneCallAgainstExact) {
  Scene const scene = street();
  Renderer renderer = renderer_of(scene);
  for (SunDirection const sun : {sun_at(160, 25), sun_at(120, 40), sun_at(240, 12)}) {
    auto const answers = renderer.projected_sunlit_areas(sun, all_of(scene));
    for (SurfaceId id = 0; id < scene.size(); ++id) {
      EXPECT_NEAR(answers[id].projected_area, exact::projected_sunlit_area(scene, sun, id),
                  1e-3 * area(scene[id].polygon))
          << scene[id].name << ' ' << id;
    }
  }
}

// More than the 255 marks between two clears.
TEST(Sunlit, FourHundredReceiversInOneCall) {
  Scene const scene = street();
  Renderer renderer = renderer_of(scene, 64);
  std::vector<SurfaceId> repeated;
  for (int i = 0; i < 13; ++i) {
    auto const ids = all_of(scene);
    repeated.insert(repeated.end(), ids.begin(), ids.end());
  }
  auto const once = areas(renderer.projected_sunlit_areas(sun_at(160, 25), all_of(scene)));
  auto const often = areas(renderer.projected_sunlit_areas(sun_at(160, 25), repeated));
  EXPECT_GT(renderer.statistics().receivers_drawn, 13U * 40U);
  for (std::size_t i = 0; i < often.size(); ++i) EXPECT_EQ(often[i], once[i % once.size()]) << i;
}

TEST(Sunlit, TheSameTwiceToTheBit) {
  Scene const scene = street();
  Renderer one = renderer_of(scene);
  Renderer other = renderer_of(scene);
  SunDirection const sun = sun_at(200, 30);
  auto const first = areas(one.projected_sunlit_areas(sun, all_of(scene)));
  one.projected_sunlit_areas(sun_at(100, 10), all_of(scene));
  EXPECT_EQ(first, areas(one.projected_sunlit_areas(sun, all_of(scene))));
  EXPECT_EQ(first, areas(other.projected_sunlit_areas(sun, all_of(scene))));
}

TEST(Sunlit, WhateverTheOrderOfReceivers) {
  Scene const scene = street();
  Renderer renderer = renderer_of(scene);
  SunDirection const sun = sun_at(200, 30);
  std::vector<SurfaceId> const forth = all_of(scene);
  std::vector<SurfaceId> const back(forth.rbegin(), forth.rend());
  auto const forward = areas(renderer.projected_sunlit_areas(sun, forth));
  auto const backward = areas(renderer.projected_sunlit_areas(sun, back));
  EXPECT_EQ(forward, std::vector<double>(backward.rbegin(), backward.rend()));
  EXPECT_EQ(forward[4], sunlit(renderer, sun, 4).projected_area);
}

TEST(Sunlit, TwoRenderersOnTwoThreads) {
  Scene const scene = street();
  Renderer alone = renderer_of(scene);
  std::array<SunDirection, 2> const suns{sun_at(150, 20), sun_at(220, 35)};
  std::array<std::vector<double>, 2> expected;
  for (std::size_t i = 0; i < 2; ++i) {
    expected[i] = areas(alone.projected_sunlit_areas(suns[i], all_of(scene)));
  }
  auto const work = [&](std::size_t which) {
    Renderer own = renderer_of(scene);
    for (int times = 0; times < 20; ++times) {
      EXPECT_EQ(areas(own.projected_sunlit_areas(suns[which], all_of(scene))), expected[which]);
    }
  };
  std::thread first(work, 0);
  std::thread second(work, 1);
  first.join();
  second.join();
}

// A renderer made on one thread and used on another.
TEST(Sunlit, ARendererMayChangeThreads) {
  Scene const scene = street();
  Renderer renderer = renderer_of(scene);
  SunDirection const sun = sun_at(150, 20);
  auto const here = areas(renderer.projected_sunlit_areas(sun, all_of(scene)));
  std::vector<double> there;
  std::thread([&] { there = areas(renderer.projected_sunlit_areas(sun, all_of(scene))); }).join();
  EXPECT_EQ(here, there);
}

// More than a software renderer keeps at once: one like another, whatever it draws in between.
TEST(Sunlit, ManyReceiversAtOnceAreCountedRight) {
  constexpr int receivers = 400;
  constexpr int strips = 50;
  Scene scene;
  std::vector<SurfaceId> asked;
  asked.reserve(receivers);
  for (int i = 0; i < receivers; ++i) {
    asked.push_back(scene.add({"receiver", level(2.0 * i, 0, 0, 1, 1), Casting::never}));
  }
  for (int i = 0; i < receivers; ++i) {
    for (int k = 0; k < strips; ++k) {
      scene.add({"strip", level(2.0 * i + k / 50.0, 0, 0.5, 1.0 / strips, 0.5)});
    }
  }
  Renderer renderer = renderer_of(std::move(scene), 1024);
  SunDirection const sun = sun_at(180, 89.9);
  for (Sunlit const& answer : renderer.projected_sunlit_areas(sun, asked)) {
    ASSERT_NEAR(answer.projected_area, 0.5, 2e-3);
  }
}

}  // namespace
}  // namespace gpu_shading
