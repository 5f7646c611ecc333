#include "answers/cached_renderer.h"

#include <gtest/gtest.h>

#include <array>

namespace gpu_shading::energyplus {
namespace {

Polygon rectangle(glm::dvec3 const& corner, glm::dvec3 const& u, glm::dvec3 const& v) {
  return {{corner, corner + u, corner + u + v, corner + v}, {}};
}

SunDirection sun(double azimuth, double altitude) {
  constexpr double degree = 3.14159265358979323846 / 180.0;
  return {azimuth * degree, altitude * degree};
}

// A window that faces south, a floor, and walls that face west and east, outside.
struct House {
  Scene scene;
  SurfaceId window = scene.add({"window", rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, 2})});
  SurfaceId floor = scene.add({"floor", rectangle({0, 0, 0}, {0, 4, 0}, {2, 0, 0})});
  SurfaceId west = scene.add({"west", rectangle({0, 4, 0}, {0, -4, 0}, {0, 0, 3})});
  SurfaceId east = scene.add({"east", rectangle({2, 0, 0}, {0, 4, 0}, {0, 0, 3})});
};

Renderer renderer_of(Scene scene) {
  RendererOptions options;
  options.device = parse_device_choice("cpu");
  return {std::move(scene), options};
}

TEST(AskedWindow, ForeseesTheListByTheSidesOfTheSun) {
  House const house;
  AskedWindow window(house.scene, house.window);
  EXPECT_EQ(window.foresee(to_vector(sun(120, 30))), nullptr) << "never asked";
  InteriorKey const morning({house.window, {house.floor, house.west}});
  InteriorKey const afternoon({house.window, {house.floor, house.east}});
  window.ask(house.scene, morning, to_vector(sun(120, 30)));
  window.ask(house.scene, afternoon, to_vector(sun(200, 40)));
  for (double const azimuth : {100.0, 150.0, 179.0}) {
    auto const* const foreseen = window.foresee(to_vector(sun(azimuth, 20)));
    ASSERT_NE(foreseen, nullptr) << azimuth;
    EXPECT_EQ(foreseen->hash, morning.hash) << azimuth;
  }
  auto const* const foreseen = window.foresee(to_vector(sun(240, 20)));
  ASSERT_NE(foreseen, nullptr);
  EXPECT_EQ(foreseen->hash, afternoon.hash);
  EXPECT_EQ(window.foresee(to_vector(sun(60, 20))), nullptr) << "the sun is behind the window";
}

TEST(CachedRenderer, InteriorsAreAsAskedForOneByOne) {
  House const house;
  CachedRenderer answers(renderer_of(house.scene), std::nullopt, {});
  std::vector<SunDirection> day(12);
  for (std::size_t hour = 0; hour < day.size(); ++hour) {
    auto const hours = static_cast<double>(hour);
    day[hour] = sun(95 + 14.5 * hours, 20 + hours);
  }
  for (int time = 0; time < 2; ++time) {
    for (std::size_t i = 0; i < day.size(); ++i) {
      auto const side = day[i].azimuth < 3.14159 ? house.west : house.east;
      InteriorKey const key({house.window, {house.floor, side}});
      auto const& found = answers.interior(key, {day[i], std::span(day).subspan(i + 1)}, {});
      auto const expected =
          renderer_of(house.scene)
              .interior_sunlit_areas(day[i], house.window, key.question.interiors);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(found[k], static_cast<float>(expected[k].projected_area)) << i << ", " << k;
      }
    }
  }
}

TEST(CachedRenderer, ReceiversThatAreNeverAskedAboutAreRenderedOnce) {
  House const house;
  std::array const all{house.window, house.floor, house.west, house.east};
  CachedRenderer answers(renderer_of(house.scene), std::nullopt, all);
  auto const rendered = [&] {
    auto const counts = answers.renderer().statistics();
    return counts.receivers_drawn + counts.receivers_clear;
  };
  auto const at_noon = sun(180, 40);
  answers.area(house.window, {at_noon, {}}, {});
  answers.area(house.east, {at_noon, {}}, {});
  auto const first = rendered();
  std::vector<SunDirection> const ahead{sun(150, 30), sun(140, 30)};
  answers.area(house.window, {sun(160, 30), ahead}, {});
  auto const asked = std::size_t{3} * 2;  // the window and the wall that faces east
  EXPECT_EQ(rendered() - first, asked);
  for (auto const& next : ahead) {
    answers.area(house.window, {next, {}}, {});
    answers.area(house.east, {next, {}}, {});
  }
  EXPECT_EQ(rendered() - first, asked);
}

// Louvres before a window; the floor behind it is asked for at one of two directions.
TEST(CachedRenderer, ErrorsAreThoseOfWhatWasAskedFor) {
  House house;
  constexpr int louvres = 300;
  for (int i = 0; i < louvres; ++i) {
    auto const corner = glm::dvec3(-1.0, -0.2, -0.5 + 0.011 * i);
    house.scene.add({"louvre", rectangle(corner, {4, 0.001 * i, 0}, {0, 0.01, 0.003})});
  }
  CachedRenderer answers(renderer_of(house.scene), std::nullopt, {});
  std::vector<SunDirection> const ahead{sun(170, 30), sun(140, 30)};
  answers.area(house.window, {sun(180, 40), ahead}, {});
  answers.area(house.window, {sun(0, 40), {}}, {});  // which it faces away from
  auto const outside = answers.errors();
  EXPECT_EQ(outside.sampled(), 1U);
  EXPECT_EQ(outside.exact() + outside.not_measured(), 0U);
  answers.interior(InteriorKey({house.window, {house.floor}}), {sun(180, 40), ahead}, {});
  auto const errors = answers.errors();
  EXPECT_EQ(errors.sampled(), 2U);
  EXPECT_GT(errors.largest_of(house.window), Sunlit::rounding);
  EXPECT_EQ(errors.largest_of(house.window), errors.largest());
  EXPECT_EQ(errors.largest_of(house.floor), Sunlit::rounding);
}

}  // namespace
}  // namespace gpu_shading::energyplus
