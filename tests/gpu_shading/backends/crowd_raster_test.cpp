#include "backends/cpu/crowd_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "antialias/antialias.h"
#include "geometry/triangulation.h"
#include "support/crowds.h"
#include "support/lit_on_cpu.h"
#include "support/random_scene.h"
#include "support/regular_shades.h"
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
      TileGrid const grid = sample_grid(tile, view, {});
      double const expected = lit_on_cpu(coverage, tile, grid, view, in_view, 1);
      in_view.crowd = &crowd;
      in_view.question = {0, towards_sun};
      for (int const threads : {1, 3}) {
        EXPECT_EQ(lit_on_cpu(coverage, tile, grid, view, in_view, threads), expected)
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

double percentile_99(std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() * 99 / 100 - 1];
}

double percentile_99_of_errors(std::vector<double> const& found,
                               std::vector<double> const& expected) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.size(); ++i) errors.push_back(std::abs(found[i] - expected[i]));
  return percentile_99(std::move(errors));
}

Renderer renderer_within(double error, Scene const& scene) {
  RendererOptions options;
  options.device = on_cpu;
  options.error = error;
  return Renderer(scene, options);
}

std::vector<double> lit_fractions(Scene const& scene, std::vector<SunDirection> const& suns,
                                  double error) {
  Renderer renderer = renderer_within(error, scene);
  SurfaceId const receiver = 0;
  auto const answers = renderer.projected_sunlit_areas(suns, {&receiver, 1});
  glm::dvec3 const normal = plane_frame(scene[0].polygon)->normal;
  double const whole = area(scene[0].polygon);
  std::vector<double> fractions;
  for (std::size_t i = 0; i < suns.size(); ++i) {
    double const cosine = glm::dot(normal, to_vector(suns[i]));
    fractions.push_back(answers[i].front().projected_area / (cosine * whole));
  }
  return fractions;
}

TEST(RepeatingCrowd, MeetsTheTarget) {
  std::vector<SunDirection> const suns = spread_suns(400);
  for (bool const upright : {false, true}) {
    for (auto const& [count, target] :
         {std::pair(500, 1e-2), {3000, 1e-2}, {20000, 1e-2}, {5000, 1e-3}, {20000, 1e-3}}) {
      SCOPED_TRACE(testing::Message()
                   << count << (upright ? " fins at " : " louvres at ") << target);
      RegularShades const shades{count, upright};
      std::vector<double> expected;
      expected.reserve(suns.size());
      for (SunDirection const sun : suns) expected.push_back(shades.sunlit_fraction(sun));
      std::vector<double> const lit = lit_fractions(shades.scene(), suns, target);
      // 20,000 fins at 1e-3: 1.03e-3.
      EXPECT_LE(percentile_99_of_errors(lit, expected), 1.1 * target);
    }
  }
}

// Long battens in front of a window, at places along a direction in its plane.
Scene battens(std::vector<double> const& places, double turn, double width) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  glm::dvec3 const along(std::cos(turn), 0.0, std::sin(turn));
  glm::dvec3 const across(-std::sin(turn), 0.0, std::cos(turn));
  for (double const place : places) {
    glm::dvec3 const corner = glm::dvec3(1.5, -0.2, 1.0) - 6.0 * along + place * across;
    scene.add({"batten", parallelogram(corner, 12.0 * along, width * across)});
  }
  return scene;
}

TEST(RepeatingCrowd, MeetsTheTargetWhereverItsBladesAre) {
  constexpr int count = 2000;
  constexpr double target = 1e-2;
  std::mt19937 generator{3};
  std::vector<double> even;
  std::vector<double> random;
  std::vector<double> groups;
  for (int i = 0; i < count; ++i) {
    even.push_back(6.0 * i / count - 3.0);
    random.push_back(6.0 * static_cast<double>(generator()) / std::mt19937::max() - 3.0);
    groups.push_back(even.back() + (i / 100 % 2 == 0 ? 0.0 : 0.2 / count));
  }
  std::vector<std::pair<char const*, Scene>> scenes;
  scenes.emplace_back("inclined", battens(even, 0.5, 3.0 / count));
  scenes.emplace_back("upright and random", battens(random, 1.5707963, 3.0 / count));
  scenes.emplace_back("level and random", battens(random, 0.0, 3.0 / count));
  scenes.emplace_back("in groups", battens(groups, 0.0, 2.0 / count));
  Scene crossed = battens(even, 0.0, 1.0 / count);
  Scene const others = battens(even, 1.2, 1.0 / count);
  for (SurfaceId id = 1; id < others.size(); ++id) crossed.add(others[id]);
  scenes.emplace_back("crossed", std::move(crossed));
  std::vector<SunDirection> const suns = spread_suns(100);
  for (auto const& [name, scene] : scenes) {
    std::vector<double> const expected = lit_fractions(scene, suns, 5e-5);
    std::vector<double> const lit = lit_fractions(scene, suns, target);
    EXPECT_LE(percentile_99_of_errors(lit, expected), target) << name;
  }
}

// Rows of samples run along pieces that are much shorter than the receiver.
TEST(RepeatingCrowd, MeetsTheTargetBehindPieces) {
  std::vector<SunDirection> const suns = spread_suns(200);
  Scene const scene = pieces_of_louvres(8000);
  std::vector<double> const expected = lit_fractions(scene, suns, 5e-5);
  for (double const target : {1e-2, 1e-3}) {
    std::vector<double> const lit = lit_fractions(scene, suns, target);
    EXPECT_LE(percentile_99_of_errors(lit, expected), target);
  }
}

// Parallelograms of one size, turned at random, in clumps: balls with so many each, or all over the
// box in front of the window if there is one clump.
Scene random_crowd(int clumps, int in_each, glm::dvec2 const& size) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  std::mt19937 generator{7};
  auto const between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  for (int clump = 0; clump < clumps; ++clump) {
    glm::dvec3 const middle(between(-0.5, 3.5), between(-2.0, -0.5), between(-0.5, 4.0));
    for (int i = 0; i < in_each;) {
      glm::dvec3 place(between(-1, 1), between(-1, 1), between(-1, 1));
      if (clumps == 1) {
        place = glm::dvec3(1.5, -1.2, 1.75) + place * glm::dvec3(2.0, 0.9, 2.25);
      } else {
        if (glm::length(place) > 1.0) continue;
        place = middle + 0.3 * place;
      }
      glm::dvec3 const long_side(between(-1, 1), between(-1, 1), between(-1, 1));
      glm::dvec3 const other(between(-1, 1), between(-1, 1), between(-1, 1));
      glm::dvec3 const side = glm::cross(long_side, other);
      scene.add({"leaf", parallelogram(place, size.x * glm::normalize(long_side),
                                       size.y * glm::normalize(side))});
      ++i;
    }
  }
  return scene;
}

TEST(RandomCrowd, MeetsTheTargetWhereverItsCastersAre) {
  std::vector<std::pair<char const*, Scene>> scenes;
  scenes.emplace_back("leaves", random_crowd(1, 40000, {0.02, 0.02}));
  scenes.emplace_back("small leaves", random_crowd(1, 200000, {0.009, 0.009}));
  scenes.emplace_back("crowns", random_crowd(40, 3000, {0.015, 0.01}));
  scenes.emplace_back("twigs", random_crowd(1, 60000, {0.3, 0.0013}));
  Scene walls = random_crowd(1, 100000, {0.01, 0.01});
  Scene const large = random_crowd(1, 30, {1.0, 0.4});
  for (SurfaceId id = 1; id < large.size(); ++id) walls.add(large[id]);
  scenes.emplace_back("leaves and a few walls", std::move(walls));
  std::vector<SunDirection> const suns = spread_suns(100);
  for (auto const& [name, scene] : scenes) {
    std::vector<double> const expected = lit_fractions(scene, suns, 5e-5);
    for (double const target : {1e-2, 1e-3}) {
      std::vector<double> const lit = lit_fractions(scene, suns, target);
      EXPECT_LE(percentile_99_of_errors(lit, expected), target) << name;
    }
  }
}

// Receivers that fill little of the rectangle about them.
TEST(Crowds, MeetTheTargetOnAThinReceiver) {
  Ring const triangle{{0, 0, 0}, {3, 0, 0}, {0, 0, 2}};
  Ring const strip{{0, 0, 0}, {0.2, 0, 0}, {3, 0, 2}, {2.8, 0, 2}};
  Ring const angle{{0, 0, 0}, {3, 0, 0}, {3, 0, 0.05}, {0.05, 0, 0.05}, {0.05, 0, 2}, {0, 0, 2}};
  std::vector<std::pair<char const*, Scene>> scenes;
  scenes.emplace_back("leaves", random_crowd(1, 40000, {0.02, 0.02}));
  scenes.emplace_back("louvres", RegularShades{3000, false}.scene());
  scenes.emplace_back("fins", RegularShades{3000, true}.scene());
  std::vector<SunDirection> const suns = spread_suns(100);
  for (auto const& [name, crowd] : scenes) {
    for (Ring const& outline : {triangle, strip, angle}) {
      Scene scene;
      scene.add({"receiver", {outline, {}}});
      for (SurfaceId id = 1; id < crowd.size(); ++id) scene.add(crowd[id]);
      std::vector<double> const expected = lit_fractions(scene, suns, 5e-5);
      for (double const target : {1e-2, 1e-3}) {
        std::vector<double> const lit = lit_fractions(scene, suns, target);
        EXPECT_LE(percentile_99_of_errors(lit, expected), target)
            << name << " in front of " << outline.size() << " corners";
      }
    }
  }
}

// A room behind the window, whose edges are level, as louvres and their rows of samples are.
struct Room {
  Scene scene;
  InteriorQuestion question{0, {}};

  explicit Room(Scene const& shaded) : scene(shaded) {
    add(parallelogram({-1, 0, -1}, {5, 0, 0}, {0, 4, 0}));
    add(parallelogram({-1, 0, 3}, {0, 4, 0}, {5, 0, 0}));
    add(parallelogram({-1, 4, -1}, {5, 0, 0}, {0, 0, 4}));
    add(parallelogram({-1, 0, -1}, {0, 4, 0}, {0, 0, 4}));
    add(parallelogram({4, 0, -1}, {0, 0, 4}, {0, 4, 0}));
  }
  void add(Polygon const& polygon) {
    question.interiors.push_back(static_cast<SurfaceId>(scene.size()));
    Surface surface{"inside", polygon};
    surface.casting = Casting::never;
    scene.add(surface);
  }
};

// Of the window's area, of each sun and surface of the room.
std::vector<double> sunlit_inside(Room const& room, std::vector<SunDirection> const& suns,
                                  double error) {
  auto const answers =
      renderer_within(error, room.scene).interior_sunlit_areas(suns, {&room.question, 1});
  glm::dvec3 const normal = plane_frame(room.scene[0].polygon)->normal;
  double const whole = area(room.scene[0].polygon);
  std::vector<double> fractions;
  for (std::size_t i = 0; i < suns.size(); ++i) {
    double const cosine = glm::dot(normal, to_vector(suns[i]));
    for (Sunlit const& lit : answers[i][0]) {
      fractions.push_back(lit.projected_area / (cosine * whole));
    }
  }
  return fractions;
}

TEST(RepeatingCrowd, MeetsTheTargetBehindAWindow) {
  Room const room(RegularShades{20000, false}.scene());
  std::vector<SunDirection> const suns = spread_suns(50);
  std::vector<double> const expected = sunlit_inside(room, suns, 2e-5);
  for (double const target : {1e-2, 1e-3}) {
    EXPECT_LE(percentile_99_of_errors(sunlit_inside(room, suns, target), expected), target);
  }
}

TEST(RandomCrowd, MeetsTheTargetBehindAWindow) {
  Room const room(random_crowd(1, 200000, {0.009, 0.009}));
  std::vector<SunDirection> const suns = spread_suns(50);
  std::vector<double> const expected = sunlit_inside(room, suns, 2e-5);
  for (double const target : {1e-2, 1e-3}) {
    EXPECT_LE(percentile_99_of_errors(sunlit_inside(room, suns, target), expected), target);
  }
}

TEST(LitCrowds, AnswerAsIfTheWindowHadNotBeenAskedAbout) {
  Room const room(mixed_crowd(20000));
  std::vector<SunDirection> const suns = spread_suns(8);
  RendererOptions options;
  options.device = on_cpu;
  Renderer alone(room.scene, options);
  Renderer both(room.scene, options);
  SurfaceId const window = room.question.window;
  auto const lit = alone.projected_sunlit_areas(suns, {&window, 1});
  auto const expected = alone.interior_sunlit_areas(suns, {&room.question, 1});
  for (int times = 0; times < 2; ++times) {
    auto const lit_again = both.projected_sunlit_areas(suns, {&window, 1});
    auto const inside = both.interior_sunlit_areas(suns, {&room.question, 1});
    for (std::size_t i = 0; i < suns.size(); ++i) {
      EXPECT_EQ(lit_again[i][0].projected_area, lit[i][0].projected_area);
      for (std::size_t k = 0; k < room.question.interiors.size(); ++k) {
        EXPECT_EQ(inside[i][0][k].projected_area, expected[i][0][k].projected_area);
      }
    }
  }
}

TEST(LitCrowds, KeepEachMaskOnceAndTheNewest) {
  PixelMask mask;
  mask.start(64, 0, 1 << 15);
  mask.words()[7] = 5;
  LitCrowds crowds;
  LitCrowds::Key key{3, {0, -1, 0}, 0.5, {64, 1 << 15, 0.0}, 0};
  for (SurfaceId receiver = 0; receiver < 300; ++receiver) {
    key.receiver = receiver;
    crowds.keep(key, mask);
  }
  PixelMask found;
  ASSERT_TRUE(crowds.take(key, found));
  EXPECT_EQ(found.words()[7], 5U);
  EXPECT_FALSE(crowds.take(key, found));
  key.receiver = 0;
  EXPECT_FALSE(crowds.take(key, found)) << "300 masks of 256 KiB";
  key.receiver = 100;
  key.towards_sun.z = 1e-9;
  EXPECT_FALSE(crowds.take(key, found));
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
