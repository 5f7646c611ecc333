// The same answers on any number of threads, and of questions asked one by one or many at once.

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "gpu_shading/device.h"
#include "gpu_shading/transmittance.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

constexpr SurfaceId windows = 4;

// The leaves are nearly all in front of the first window.
Scene leafy_facade(int leaves, bool transparent) {
  Scene scene;
  for (SurfaceId i = 0; i < windows; ++i) scene.add({"window", south_facing(6.0 * i, 0, 0, 3, 2)});
  std::mt19937 engine(5);
  auto const random = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
  };
  auto const glass = std::make_shared<Transmittance const>(
      Transmittance::polynomial_in_cosine({0.0, 2.4, -2.4, 0.8}));
  for (int i = 0; i < leaves; ++i) {
    glm::dvec3 const at(random(0, i % 100 == 0 ? 20 : 3), random(-1.5, -0.2), random(0, 2));
    Surface leaf{"leaf", parallelogram(at, {0.02, random(-0.01, 0.01), 0}, {0, 0, 0.02})};
    if (transparent) leaf.filter.set(AngularTransmittance{glass});
    scene.add(leaf);
  }
  return scene;
}

std::vector<std::vector<double>> areas(Scene const& scene, int threads, std::size_t at_once) {
  limit_threads(threads);
  tbb::task_arena arena(threads);
  std::vector<std::vector<double>> found;
  arena.execute([&] {
    Renderer renderer = renderer_of(scene, 256);
    std::vector<SunDirection> suns;
    suns.reserve(36);
    for (int i = 0; i < 36; ++i) suns.push_back(sun_at(150 + 2 * i, 12 + i));
    for (std::size_t first = 0; first < suns.size(); first += at_once) {
      auto const answers = renderer.projected_sunlit_areas(std::span(suns).subspan(first, at_once),
                                                           std::vector<SurfaceId>{0, 1, 2, 3});
      for (std::vector<Sunlit> const& direction : answers) {
        std::vector<double>& row = found.emplace_back();
        for (Sunlit const& sunlit : direction) row.push_back(sunlit.projected_area);
      }
    }
  });
  limit_threads(4096);
  return found;
}

class OnThreads : public testing::TestWithParam<bool> {};

TEST_P(OnThreads, AnswersAreTheSame) {
  Scene const scene = leafy_facade(GetParam() ? 6000 : 9000, GetParam());
  auto const alone = areas(scene, 1, 1);
  EXPECT_GT(alone.front().front(), 0.0);
  EXPECT_LT(alone.front().front(), alone.front().back());
  for (int const threads : {1, 2, 16}) {
    for (std::size_t const at_once : {std::size_t{1}, std::size_t{36}}) {
      EXPECT_EQ(areas(scene, threads, at_once), alone) << threads << ", " << at_once;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BehindOpaqueAndTransparentLeaves, OnThreads, testing::Bool());

}  // namespace
}  // namespace gpu_shading
