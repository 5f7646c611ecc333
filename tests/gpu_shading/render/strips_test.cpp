// The strips of wall around windows that nearly fill it, against exact polygon clipping.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/exact.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

constexpr double width = 4.0;
constexpr double height = 3.0;

using Shades = std::function<void(Scene&)>;

void overhang(Scene& scene) {
  scene.add(
      {"overhang", parallelogram({-0.3, 0, height + 0.2}, {width + 0.6, 0, 0}, {0, -1.1, 0})});
}

void touching_overhang(Scene& scene) {
  scene.add({"overhang", parallelogram({0, 0, height}, {width, 0, 0}, {0, -0.01, 0})});
}

void fins(Scene& scene, double gap) {
  constexpr int count = 20;
  for (int i = 0; i < count; ++i) {
    scene.add(
        {"fin", parallelogram({0.01 + i * width / count, -gap, 0}, {0, -0.3, 0}, {0, 0, height})});
  }
}

void louvres(Scene& scene) {
  constexpr int count = 100;
  for (int i = 0; i < count; ++i) {
    scene.add({"louvre", parallelogram({0, -0.1, 0.013 + i * height / count}, {width, 0, 0},
                                       {0, -0.04, -0.02})});
  }
}

// By its holes.
void screen(Scene& scene) {
  Polygon sheet = south_facing(-0.5, -0.1, -0.5, width + 1, height + 1);
  for (double x = -0.45; x < width + 0.4; x += 0.1) {
    for (double z = -0.45; z < height + 0.4; z += 0.1) {
      sheet.holes.push_back(south_facing(x, -0.1, z, 0.06, 0.06).outline);
    }
  }
  scene.add({"screen", sheet});
}

Scene wall_with(double strip, Shades const& shades) {
  Scene scene;
  Polygon wall = south_facing(0, 0, 0, width, height);
  wall.holes.push_back(
      south_facing(strip, 0, strip, width - 2.0 * strip, height - 2.0 * strip).outline);
  scene.add({"wall", wall});
  shades(scene);
  return scene;
}

// Of the wall's area.
std::vector<double> errors(Scene const& scene, std::vector<SunDirection> const& suns) {
  RendererOptions options;
  options.device = on_cpu;
  Renderer renderer(scene, options);
  std::vector<double> errors;
  for (SunDirection const sun : suns) {
    double const whole = exact::projected_area(scene, sun, 0);
    if (whole <= 0.0) continue;
    double const lit = sunlit(renderer, sun, 0).projected_area;
    errors.push_back(std::abs(lit - exact::projected_sunlit_area(scene, sun, 0)) / whole);
  }
  return errors;
}

std::vector<SunDirection> suns() {
  std::vector<SunDirection> suns;
  for (double const azimuth : {95.0, 130.0, 175.0, 235.0, 260.0}) {
    for (double const altitude : {10.0, 30.0, 63.0, 75.0, 85.0}) {
      suns.push_back(sun_at(azimuth, altitude));
    }
  }
  return suns;
}

class Strips : public testing::TestWithParam<double> {};

TEST_P(Strips, AreAsAccurateAsWholeWalls) {
  std::vector<std::pair<std::string, Shades>> const kinds{
      {"overhang", overhang},
      {"overhang that touches", touching_overhang},
      {"fins", [](Scene& scene) { fins(scene, 0.02); }},
      {"fins that touch", [](Scene& scene) { fins(scene, 0.0); }},
      {"louvres", louvres},
      {"screen", screen}};
  double const target = RendererOptions().error;
  std::size_t views = 0;
  std::size_t beyond = 0;
  for (auto const& [name, shades] : kinds) {
    for (double const error : errors(wall_with(GetParam(), shades), suns())) {
      ++views;
      if (error > target) ++beyond;
      EXPECT_LE(error, 1.5 * target) << name;
    }
  }
  EXPECT_GE(views, 100U);
  EXPECT_LE(100 * beyond, views);
}

INSTANTIATE_TEST_SUITE_P(Of1To30Mm, Strips, testing::Values(1e-3, 3e-3, 1e-2, 3e-2));

// No strip beside a shade that touches its receiver is lit, however flat the sun.
TEST(TouchingShades, LeaveNoStripLit) {
  constexpr int count = 200;
  Scene scene;
  scene.add({"wall", south_facing(0, 0, 0, 1, 1)});
  for (int i = 0; i < count; ++i) {
    double const x = static_cast<double>(i) / count;
    scene.add({"fin", parallelogram({x, 0, 0}, {0, -0.001, 0}, {0, 0, 1})});
  }
  EXPECT_LE(errors(scene, {sun_at(100, 0)}).at(0), 1e-4);
}

// As docs/explanation/limits.md states.
TEST(TouchingShades, WithinATenthOfAMillimetreOfThePlaneCastNothing) {
  auto const missed = [](double depth) {
    Scene scene;
    scene.add({"wall", south_facing(0, 0, 0, 1, 1)});
    scene.add({"fin", parallelogram({0.5, 0, 0}, {0, -depth, 0}, {0, 0, 1})});
    return errors(scene, {sun_at(100, 0)}).at(0);
  };
  double const shadow = 0.99e-4 * std::tan(80.0 * degree);
  EXPECT_NEAR(missed(0.99e-4), shadow, 1e-6);
  EXPECT_LE(missed(1.01e-4), 1e-6);
}

}  // namespace
}  // namespace gpu_shading
