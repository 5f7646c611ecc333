// ASHRAE 1052-RP: sunlit area of a window under an overhang and beside a fin, in closed form.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "support/shapes.h"

namespace gpu_shading {
namespace {

constexpr double width = 3.0;
constexpr double height = 3.0;
constexpr double overhang_depth = 0.6;
constexpr double fin_depth = 1.0;

// Wall azimuth g: of the sun from the facade's normal. The profile angle's tangent is
// tan(altitude) / cos(g). Overhang and fin reach far enough past the window not to end in it.
double lit_area(double g, double altitude) {
  double const profile = std::tan(altitude) / std::cos(g);
  double const wide = width - fin_depth * std::abs(std::tan(g));
  double const tall = height - overhang_depth * profile;
  return std::max(0.0, wide) * std::max(0.0, tall);
}

// A facade facing south, turned by `turn` about the vertical (clockwise from above) and moved.
Scene facade(double turn, glm::dvec3 const& move, bool fin_in_the_east) {
  auto const placed = [&](Polygon polygon) {
    for (glm::dvec3& p : polygon.outline) {
      p = glm::dvec3(std::cos(turn) * p.x + std::sin(turn) * p.y,
                     -std::sin(turn) * p.x + std::cos(turn) * p.y, p.z) +
          move;
    }
    return polygon;
  };
  Scene scene;
  scene.add({"window", placed(south_facing(0, 0, 0, width, height))});
  scene.add({"overhang", placed(level(-20, -overhang_depth, height, 43, overhang_depth))});
  double const x = fin_in_the_east ? width : 0.0;
  scene.add({"fin", placed(parallelogram({x, 0, -20}, {0, -fin_depth, 0}, {0, 0, 43}))});
  return scene;
}

TEST(OverhangAndFin, AtADozenSuns) {
  for (bool const east : {false, true}) {
    Renderer renderer = renderer_of(facade(0.0, {}, east));
    for (double const g : {0.0, 10.0, 35.0, 60.0}) {
      for (double const altitude : {5.0, 30.0, 55.0}) {
        SunDirection const sun = sun_at(180.0 - (east ? g : -g), altitude);
        double const cosine = std::cos(g * degree) * std::cos(altitude * degree);
        double const exact = lit_area(g * degree, altitude * degree) * cosine;
        EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area, exact, 0.003 * width * height)
            << "wall azimuth " << g << ", altitude " << altitude;
      }
    }
  }
}

// Float32 is 3 cm coarse there.
TEST(OverhangAndFin, TurnedAndFiveHundredKilometresAway) {
  double const turn = 23.0;
  Renderer near = renderer_of(facade(turn * degree, {}, false));
  Renderer far = renderer_of(facade(turn * degree, {5e5, -5e5, 1234.5}, false));
  for (double const g : {0.0, 20.0, 55.0}) {
    SunDirection const sun = sun_at(180.0 + turn + g, 35.0);
    double const exact =
        lit_area(g * degree, 35 * degree) * std::cos(g * degree) * std::cos(35 * degree);
    double const there = sunlit(far, sun, 0).projected_area;
    EXPECT_NEAR(there, exact, 0.003 * width * height);
    EXPECT_NEAR(there / (width * height), sunlit(near, sun, 0).projected_area / (width * height),
                2e-5);
  }
}

// One model that holds both: the building at the origin and one 500 km away.
TEST(OverhangAndFin, FarFromTheScenesFirstSurface) {
  Scene scene;
  scene.add({"elsewhere", level(0, 0, 0, 1, 1)});
  Scene const there = facade(0.0, {5e5, -5e5, 1234.5}, false);
  for (SurfaceId id = 0; id < there.size(); ++id) scene.add(there[id]);
  Renderer renderer = renderer_of(scene);
  double const g = 30.0 * degree;
  double const altitude = 40.0 * degree;
  EXPECT_NEAR(sunlit(renderer, sun_at(210.0, 40.0), 1).projected_area,
              lit_area(g, altitude) * std::cos(g) * std::cos(altitude), 2e-3 * width * height);
}

}  // namespace
}  // namespace gpu_shading
