// Views drawn together against views drawn one at a time.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"
#include "support/gl_renderer.h"
#include "support/random_scene.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

enum class Finish { opaque, shaded, scheduled, screened, mixed };

std::shared_ptr<Transmittance const> half() {
  return std::make_shared<Transmittance const>(Transmittance::polynomial_in_cosine({0.1, 0.4}));
}

std::shared_ptr<PerforatedScreen const> mesh() {
  HolePattern const holes(
      {.hole = Hole::Round, .arrangement = Arrangement::Staggered60, .size = 0.2, .pitch = 0.3});
  return std::make_shared<PerforatedScreen const>(holes, Sheet{.thickness = 0.02});
}

void finish(Surface& surface, Finish how, std::uint32_t which) {
  if (how == Finish::mixed) how = static_cast<Finish>(which % 4);
  if (how == Finish::shaded) surface.filter.set(AngularTransmittance{half()});
  if (how == Finish::scheduled) surface.filter.schedule = static_cast<int>(which % 3);
  if (how == Finish::screened && surface.polygon.outline.size() == 4)
    surface.filter.set(PerforatedSheet{mesh()});
}

// Random scenes on one site, each with its own casters around its receiver.
struct Site {
  Scene scene;
  std::vector<SurfaceId> receivers;  // one of each
  std::vector<SurfaceId> all;

  Site(std::uint32_t scenes, Finish how) {
    for (std::uint32_t seed = 1; seed <= scenes; ++seed) {
      RandomScene const random = random_scene(seed);
      for (SurfaceId id = 0; id < random.scene.size(); ++id) {
        Surface surface = random.scene[id];
        for (glm::dvec3& vertex : surface.polygon.outline) vertex.x += 15.0 * seed;
        for (Ring& hole : surface.polygon.holes) {
          for (glm::dvec3& vertex : hole) vertex.x += 15.0 * seed;
        }
        if (id > 0) finish(surface, how, static_cast<std::uint32_t>(id) + seed);
        SurfaceId const added = scene.add(surface);
        all.push_back(added);
        if (id == 0) receivers.push_back(added);
      }
    }
  }
};

std::vector<SunDirection> const suns{sun_at(100, 15), sun_at(150, 40), sun_at(200, 65),
                                     sun_at(240, 30), sun_at(290, 50), sun_at(30, 25)};

Renderer renderer_with(Scene const& scene, int max_layers, std::optional<LuminanceSum> sum,
                       std::optional<int> resolution) {
  return gl_renderer(scene, resolution, {.sum = sum, .max_layers = max_layers});
}

void expect_equal(Sunlit const& a, Sunlit const& b) {
  EXPECT_EQ(a.projected_area, b.projected_area);
  ASSERT_EQ(a.scheduled.size(), b.scheduled.size());
  for (std::size_t i = 0; i < a.scheduled.size(); ++i) {
    EXPECT_EQ(a.scheduled[i].powers, b.scheduled[i].powers);
    EXPECT_EQ(a.scheduled[i].projected_area, b.scheduled[i].projected_area);
  }
}

class Batches : public testing::TestWithParam<std::tuple<Finish, LuminanceSum>> {};

TEST_P(Batches, OfReceiversAndDirectionsAreEqualToTheBitToOneAtATime) {
  auto const [how, sum] = GetParam();
  Site const site(16, how);
  // By the error: tiles of several sides.
  Renderer together = renderer_with(site.scene, 0, sum, std::nullopt);
  Renderer apart = renderer_with(site.scene, 1, sum, std::nullopt);
  auto const batched = together.projected_sunlit_areas(suns, site.all);
  ASSERT_EQ(batched.size(), suns.size());
  double lit = 0.0;
  for (std::size_t i = 0; i < suns.size(); ++i) {
    ASSERT_EQ(batched[i].size(), site.all.size());
    for (std::size_t k = 0; k < site.all.size(); ++k) {
      expect_equal(batched[i][k], sunlit(apart, suns[i], site.all[k]));
      lit += batched[i][k].projected_area;
    }
  }
  EXPECT_GT(lit, 100.0);
  RendererStatistics const& did = together.statistics();
  EXPECT_GT(did.receivers_drawn, 100U);
  EXPECT_EQ(did.directions, suns.size());
  EXPECT_EQ(did.luminance_views > 0, how != Finish::opaque);
  EXPECT_EQ(did.receivers_drawn, apart.statistics().receivers_drawn);
  EXPECT_EQ(did.receivers_clear, apart.statistics().receivers_clear);
  EXPECT_EQ(did.casters_drawn, apart.statistics().casters_drawn);
}

TEST_P(Batches, OfWindowsAreEqualToTheBitToOneAtATime) {
  auto const [how, sum] = GetParam();
  Site const site(16, how);
  Renderer together = renderer_with(site.scene, 0, sum, 128);
  Renderer apart = renderer_with(site.scene, 1, sum, 128);
  std::vector<InteriorQuestion> questions;
  for (SurfaceId const window : site.receivers) questions.push_back({window, site.all});
  questions.push_back({site.receivers.front(), {}});
  double inside = 0.0;
  auto const batched = together.interior_sunlit_areas(suns, questions);
  ASSERT_EQ(batched.size(), suns.size());
  for (std::size_t n = 0; n < suns.size(); ++n) {
    ASSERT_EQ(batched[n].size(), questions.size());
    for (std::size_t i = 0; i < questions.size(); ++i) {
      auto const one =
          apart.interior_sunlit_areas(suns[n], questions[i].window, questions[i].interiors);
      ASSERT_EQ(batched[n][i].size(), one.size());
      for (std::size_t k = 0; k < one.size(); ++k) {
        expect_equal(batched[n][i][k], one[k]);
        inside += one[k].projected_area;
      }
    }
  }
  EXPECT_GT(inside, 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    All, Batches,
    testing::Combine(testing::Values(Finish::opaque, Finish::shaded, Finish::scheduled,
                                     Finish::screened, Finish::mixed),
                     testing::Values(LuminanceSum::readback, LuminanceSum::compute)));

// Pixels of opaque casters are summed exactly, whatever the way.
TEST(Batches, CountsAreTheSameByEveryWayOfSumming) {
  Site const site(6, Finish::opaque);
  Renderer compute = renderer_with(site.scene, 0, LuminanceSum::compute, 100);
  Renderer readback = renderer_with(site.scene, 0, LuminanceSum::readback, 100);
  auto const expected = readback.projected_sunlit_areas(suns, site.all);
  auto const got = compute.projected_sunlit_areas(suns, site.all);
  for (std::size_t i = 0; i < suns.size(); ++i) {
    for (std::size_t k = 0; k < site.all.size(); ++k) expect_equal(got[i][k], expected[i][k]);
    for (SurfaceId const window : site.receivers) {
      auto const inside = readback.interior_sunlit_areas(suns[i], window, site.all);
      auto const counted = compute.interior_sunlit_areas(suns[i], window, site.all);
      for (std::size_t k = 0; k < inside.size(); ++k) expect_equal(counted[k], inside[k]);
    }
  }
}

// More than one submission takes, in several kinds of view.
TEST(Batches, TwoThousandReceiversInOneCall) {
  constexpr int receivers = 2000;
  Scene scene;
  std::vector<SurfaceId> asked;
  std::vector<double> expected;
  std::vector<double> const factors{0.3};
  for (int i = 0; i < receivers; ++i) {
    int const row = i / 50;
    double const x = 3.0 * (i % 50);
    double const y = 3.0 * row;
    double const shaded = (i + 0.5) / receivers;
    asked.push_back(scene.add({"receiver", level(x, y, 0, 1, 1)}));
    Surface canopy{"canopy", level(x - 0.5, y - 0.5, 0.5, 0.5 + shaded, 2)};
    double passes = 0.0;
    if (i % 3 == 1) {
      canopy.filter.set(AngularTransmittance{half()});
      passes = 0.5;
    } else if (i % 3 == 2) {
      canopy.filter.schedule = 0;
      passes = factors[0];
    }
    scene.add(canopy);
    expected.push_back(1.0 - shaded * (1.0 - passes));
  }
  Renderer renderer = renderer_of(scene, 128);
  auto const answers = renderer.projected_sunlit_areas(SunDirection{}, asked);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    EXPECT_NEAR(answers[i].at(factors), expected[i], 2e-3) << i;
  }
  EXPECT_EQ(renderer.statistics().receivers_drawn, static_cast<std::size_t>(receivers));
}

// Submissions of one call have tables of their own, of the panes that their views see.
TEST(Batches, DrawsUnderWayKeepTheirShades) {
  Scene scene;
  std::vector<SurfaceId> asked;
  for (int i = 0; i < 20; ++i) {
    int const row = i / 5;
    asked.push_back(scene.add({"receiver", level(1 + 4.5 * (i % 5), 1 + 4.5 * row, 0, 4, 4)}));
  }
  for (int i = 0; i < 100; ++i) {
    int const row = i / 10;
    Surface pane{"pane", level(2.4 * (i % 10), 1.9 * row, 4, 2.4, 1.9)};
    pane.filter.set(AngularTransmittance{half()});
    scene.add(pane);
  }
  Renderer renderer = renderer_of(scene, 1024, by_opengl);
  for (auto const& answer : renderer.projected_sunlit_areas(SunDirection{}, asked)) {
    EXPECT_NEAR(answer.projected_area, 0.5 * 16, 1e-5);
  }
}

// What is under way when an error ends a call does not come into the next.
TEST(Batches, AnErrorLeavesNothingBehind) {
  Site const site(12, Finish::mixed);
  Renderer renderer = renderer_with(site.scene, 0, std::nullopt, 128);
  Renderer other = renderer_with(site.scene, 0, std::nullopt, 128);
  std::vector<SurfaceId> with_unknown = site.all;
  with_unknown.push_back(99999);
  EXPECT_ANY_THROW(renderer.projected_sunlit_areas(suns, with_unknown));
  auto const got = renderer.projected_sunlit_areas(suns, site.all);
  auto const expected = other.projected_sunlit_areas(suns, site.all);
  for (std::size_t i = 0; i < suns.size(); ++i) {
    for (std::size_t k = 0; k < site.all.size(); ++k) expect_equal(got[i][k], expected[i][k]);
  }
}

void expect_counted_equal_one_at_a_time(Site const& site) {
  RendererOptions options;
  options.device = on_cpu;
  Renderer together(site.scene, options);
  Renderer apart(site.scene, options);
  auto const batched = together.projected_sunlit_areas(suns, site.all);
  std::vector<InteriorQuestion> questions;
  for (SurfaceId const window : site.receivers) questions.push_back({window, site.all});
  auto const all_inside = together.interior_sunlit_areas(suns, questions);
  for (std::size_t i = 0; i < suns.size(); ++i) {
    for (std::size_t k = 0; k < site.all.size(); ++k) {
      expect_equal(batched[i][k], sunlit(apart, suns[i], site.all[k]));
    }
    auto const& inside = all_inside[i];
    for (std::size_t k = 0; k < questions.size(); ++k) {
      auto const alone =
          apart.interior_sunlit_areas(suns[i], questions[k].window, questions[k].interiors);
      for (std::size_t n = 0; n < alone.size(); ++n) expect_equal(inside[k][n], alone[n]);
    }
  }
  EXPECT_GT(together.statistics().count_seconds, 0.0);
}

TEST(Batches, OfCountedViewsAreEqualToTheBitToOneAtATime) {
  for (Finish const finish : {Finish::mixed, Finish::screened}) {
    expect_counted_equal_one_at_a_time(Site(16, finish));
  }
}

TEST(Batches, OfMoreViewsThanAreWaitedForAtATime) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  scene.add({"shade", level(-1, -2, 2.1, 5, 2), Casting::always, {{AngularTransmittance{half()}}}});
  Renderer together = renderer_with(scene, 0, std::nullopt, 8);
  Renderer apart = renderer_with(scene, 1, std::nullopt, 8);
  constexpr int questions = 17'000;
  std::vector<SunDirection> many;
  many.reserve(questions);
  for (int i = 0; i < questions; ++i) many.push_back(sun_at(150 + 60 * i / double{questions}, 30));
  SurfaceId const window = 0;
  auto const got = together.projected_sunlit_areas(many, {&window, 1});
  EXPECT_EQ(together.statistics().luminance_views, many.size());
  for (std::size_t i = 0; i < many.size(); i += 500) {
    expect_equal(got[i][0], sunlit(apart, many[i], window));
  }
}

TEST(Batches, StagesAddUpToNoMoreThanAllOfTheTime) {
  Site const site(6, Finish::mixed);
  Renderer renderer = renderer_with(site.scene, 0, std::nullopt, 128);
  renderer.projected_sunlit_areas(suns, site.all);
  RendererStatistics const& did = renderer.statistics();
  for (double const stage :
       {did.cull_seconds, did.submit_seconds, did.wait_seconds, did.read_seconds}) {
    EXPECT_GT(stage, 0.0);
  }
  EXPECT_LE(did.cull_seconds + did.submit_seconds + did.wait_seconds + did.read_seconds,
            did.seconds);
}

}  // namespace
}  // namespace gpu_shading
