// The errors that answers state (Sunlit::error), against sweeps of all edges.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "support/exact.h"
#include "support/invented_scenes.h"
#include "support/room.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

struct Answer {
  double true_error = 0.0;
  std::optional<double> stated;
};

constexpr int suns = 6;

// Of receivers of every outline, behind casters of several kinds.
std::vector<Answer> answers_by(RendererOptions const& options) {
  std::vector<Answer> answers;
  for (SceneFamily const& family : scene_families()) {
    std::string_view const name = family.name;
    if (name != "louvres" && name != "two layers" && name != "leaves" && name != "glass leaves")
      continue;
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      InventedScene const invented = family.invent(seed, suns);
      Renderer renderer(invented.scene, options);
      for (SunDirection const sun : invented.suns) {
        auto const exact = invented.reference(invented.scene, sun).fractions;
        if (exact.empty()) continue;
        Sunlit const answer = sunlit(renderer, sun, 0);
        Polygon const& receiver = invented.scene[0].polygon;
        double const area =
            gpu_shading::area(receiver) * glm::dot(normal(receiver), to_vector(sun));
        answers.push_back({std::abs(answer.projected_area / area - exact.front()), answer.error});
      }
    }
  }
  EXPECT_GT(answers.size(), 50U);
  return answers;
}

bool is_sampled(Answer const& answer) { return answer.stated && *answer.stated > 0.0; }

TEST(StatedError, IsThatOfSampledAnswers) {
  RendererOptions options;
  options.device = on_cpu;
  options.error = 1e-2;
  options.samples_only = true;
  auto answers = answers_by(options);
  std::erase_if(answers, [](Answer const& answer) { return !is_sampled(answer); });
  auto const views = static_cast<std::ptrdiff_t>(answers.size());
  EXPECT_GT(views, 40);
  // Of coordinates to 10 nm, and of outlines in single precision.
  constexpr double rounding = 1e-6;
  std::ptrdiff_t understated = 0;
  std::ptrdiff_t overstated = 0;
  for (Answer const& answer : answers) {
    EXPECT_LE(*answer.stated, options.error);
    EXPECT_LE(answer.true_error, 2.0 * *answer.stated + rounding);
    understated += answer.true_error > *answer.stated + rounding ? 1 : 0;
    overstated += *answer.stated > 10.0 * answer.true_error + rounding ? 1 : 0;
  }
  EXPECT_LE(understated, views / 20);
  EXPECT_LE(overstated, views / 2);
}

TEST(StatedError, OfExactAnswersIsRounding) {
  RendererOptions options;
  options.device = on_cpu;
  auto answers = answers_by(options);
  std::erase_if(answers, is_sampled);
  EXPECT_GT(answers.size(), 5U);
  for (Answer const& answer : answers) {
    EXPECT_EQ(answer.stated, 0.0);
    EXPECT_LE(answer.true_error, Sunlit::rounding);
  }
}

// The same number of samples whatever they show.
TEST(StatedError, IsNotMadeUpForAFixedResolution) {
  RendererOptions options;
  options.device = on_cpu;
  options.resolution = 64;
  options.samples_only = true;
  auto const answers = answers_by(options);
  EXPECT_GT(std::ranges::count_if(answers, [](Answer const& answer) { return !answer.stated; }),
            40);
  EXPECT_TRUE(std::ranges::none_of(answers, is_sampled));
}

TEST(StatedError, OfSurfacesBehindAWindowIsAShareOfTheWindow) {
  Room room;
  constexpr int louvres = 150;
  for (int i = 0; i < louvres; ++i) {
    room.scene.add(
        {"louvre", parallelogram({-3, -0.3, 0.5 + 0.0201 * i}, {9, 0, 0}, {0, 0.02, 0.007})});
  }
  RendererOptions options;
  options.device = on_cpu;
  options.error = 1e-2;
  options.samples_only = true;
  Renderer renderer(room.scene, options);
  for (double const altitude : {11.0, 23.0, 37.0, 52.0, 64.0}) {
    SunDirection const sun = sun_at(160, altitude);
    auto const answers = renderer.interior_sunlit_areas(sun, room.window, room.surfaces);
    auto const exact = exact::interior_areas(room.scene, sun, room.window, room.surfaces);
    double const all = exact::projected_area(room.scene, sun, room.window);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      ASSERT_TRUE(answers[i].error);
      EXPECT_GE(*answers[i].error, Sunlit::rounding);
      EXPECT_LE(*answers[i].error, options.error);
      EXPECT_NEAR(answers[i].projected_area / all, exact[i] / all, *answers[i].error) << altitude;
    }
  }
}

}  // namespace
}  // namespace gpu_shading
