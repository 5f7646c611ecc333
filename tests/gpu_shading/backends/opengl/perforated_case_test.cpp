#include "support/perforated_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "support/transparent_case.h"

// The perforated case of Jones & Greenberg: its reference against rays, the renderer against it.
namespace gpu_shading {
namespace {

// A case with where its tile is found by hand, on a receiver and a sheet that are level.
struct Placed {
  PerforatedCase given;
  glm::dvec2 origin;  // x and y of the tile's (0, 0)
  glm::dvec2 u;
  double near_face;  // z of the sheet's lower face
  glm::dvec2 low;    // the sheet
  glm::dvec2 high;
};

PerforatedCase big_holes(double open_fraction) {
  PerforatedCase given;
  given.hole = 0.15;
  given.open_fraction = open_fraction;
  given.thickness = 0.06;
  return given;
}

Placed facing_up() { return {big_holes(0.5), {1.0, 0.0}, {0.0, 1.0}, 0.1, {0.0, 0.0}, {1.0, 1.0}}; }

Placed moved_and_turned() {
  Placed placed = facing_up();
  placed.given = big_holes(0.7);
  placed.given.sheet = level(0.1, 0.2, 0.1, 0.8, 0.7);
  placed.given.plane = SheetPlane::centre;
  placed.given.placement = {0.03, 0.07, 25 * degree};
  placed.origin = {0.9 - 0.07, 0.2 + 0.03};
  placed.u = {-std::sin(25 * degree), std::cos(25 * degree)};
  placed.near_face = 0.07;
  placed.low = {0.1, 0.2};
  placed.high = {0.9, 0.9};
  return placed;
}

// Its outside is below.
Placed turned_over() {
  Placed placed = facing_up();
  placed.given.sheet = parallelogram({0, 0, 0.16}, {0, 1, 0}, {1, 0, 0});
  placed.given.placement = {0.02, 0.01, 0.0};
  placed.origin = {0.02, 1.0 - 0.01};
  placed.u = {1.0, 0.0};
  return placed;
}

// Many points of many rays, each against every hole: the lit share of the receiver.
double lit_by_rays(Placed const& placed, SunDirection sun) {
  constexpr int rays = 40000;
  constexpr int depths = 400;
  double const radius = placed.given.hole / 2.0;
  double const pitch = placed.given.pitch();
  // Seen from below the pattern is its mirror image, but so it is with v reversed.
  glm::dvec2 const v(-placed.u.y, placed.u.x);
  std::vector<glm::dvec2> holes;
  for (int row = -20; row <= 20; ++row) {
    for (int i = -20; i <= 20; ++i) {
      glm::dvec2 const centre = placed.origin +
                                (i + (row % 2 == 0 ? 0.0 : 0.5)) * pitch * placed.u +
                                row * std::sqrt(0.75) * pitch * v;
      if (glm::all(glm::greaterThan(centre, placed.low - radius)) &&
          glm::all(glm::lessThan(centre, placed.high + radius))) {
        holes.push_back(centre);
      }
    }
  }
  auto const is_solid = [&](glm::dvec2 const& p) {
    if (p.x < placed.low.x || p.x > placed.high.x) return false;
    if (p.y < placed.low.y || p.y > placed.high.y) return false;
    return std::none_of(holes.begin(), holes.end(), [&](glm::dvec2 const& centre) {
      return glm::dot(p - centre, p - centre) < radius * radius;
    });
  };
  glm::dvec3 const s = to_vector(sun);
  glm::dvec2 const slope(s.x / s.z, s.y / s.z);
  int lit = 0;
  for (int i = 0; i < rays; ++i) {
    // Points of the plastic number's sequence (Roberts 2018) fill the square evenly.
    double const x = 0.5 + 0.7548776662466927 * i;
    double const y = 0.5 + 0.5698402909980532 * i;
    glm::dvec2 const from(x - std::floor(x), y - std::floor(y));
    bool passes = true;
    for (int k = 0; passes && k <= depths; ++k) {
      passes = !is_solid(from + (placed.near_face + placed.given.thickness * k / depths) * slope);
    }
    lit += passes ? 1 : 0;
  }
  return static_cast<double>(lit) / rays;
}

// From high to low.
std::vector<SunDirection> suns_of_the_case() {
  return {sun_at(33, 89.9), sun_at(20, 65), sun_at(180, 50), sun_at(250, 35),
          sun_at(90, 20),   sun_at(310, 9), sun_at(135, 4)};
}

class PerforatedPlacement : public ::testing::TestWithParam<Placed (*)()> {};

TEST_P(PerforatedPlacement, ReferenceAgreesWithRaysOneByOne) {
  Placed const placed = GetParam()();
  PerforatedReference const reference(placed.given);
  for (SunDirection const sun : suns_of_the_case()) {
    EXPECT_NEAR(reference(sun) / std::sin(sun.altitude), lit_by_rays(placed, sun), 1e-3)
        << "azimuth " << sun.azimuth / degree << " altitude " << sun.altitude / degree;
  }
}

// A sheet with few holes, so that edges count.
void expect_near_reference(PerforatedCase const& given, PerforatedScreen const& screen,
                           double tolerance) {
  PerforatedReference const reference(given);
  Scene const scene = given.scene(std::make_shared<PerforatedScreen const>(screen));
  for (DeviceChoice const views : {by_opengl, on_cpu}) {
    Renderer renderer = renderer_of(scene, 1024, views);
    for (SunDirection const sun : suns_of_the_case()) {
      EXPECT_NEAR(sunlit(renderer, sun, 0).projected_area, reference(sun), tolerance)
          << "azimuth " << sun.azimuth / degree << " altitude " << sun.altitude / degree;
    }
  }
}

TEST_P(PerforatedPlacement, RendererAgreesWithReference) {
  PerforatedCase const given = GetParam()().given;
  Sheet const sheet{given.thickness, given.plane};
  expect_near_reference(given, PerforatedScreen(given.pattern(), sheet), 2e-4);
  expect_near_reference(
      given, PerforatedScreen(OpacityTile(given.pattern(), given.hole / 64), sheet), 6e-4);
}

INSTANTIATE_TEST_SUITE_P(Of, PerforatedPlacement,
                         ::testing::Values(facing_up, moved_and_turned, turned_over));

TEST(PerforatedReference, HasTheClosedFormUnderASheetWithoutEnd) {
  PerforatedCase given;
  given.sheet = level(-1, -1, 0.1, 3, 3);
  PerforatedReference const reference(given);
  SunDirection const sun = sun_at(200, 60);
  glm::dvec3 const s = to_vector(sun) * (given.thickness / std::sin(sun.altitude));
  EXPECT_NEAR(reference(sun), std::sin(sun.altitude) * given.pattern().transmittance(s.y, -s.x),
              1e-3);
}

struct Errors {
  double signed_mean = 0.0;
  double mean = 0.0;
  double largest = 0.0;
};

Errors over_the_year(PerforatedScreen const& screen, DeviceChoice views) {
  PerforatedCase const given;
  PerforatedReference const reference(given);
  std::vector<SunDirection> const suns = year_of_suns(42 * degree);
  Renderer renderer =
      renderer_of(given.scene(std::make_shared<PerforatedScreen const>(screen)), 512, views);
  Errors errors;
  constexpr std::size_t positions = 61;
  for (std::size_t i = 0; i < positions; ++i) {
    SunDirection const sun = suns[(2 * i + 1) * suns.size() / (2 * positions)];
    double const error = sunlit(renderer, sun, 0).projected_area - reference(sun);
    errors.signed_mean += error / positions;
    errors.mean += std::abs(error) / positions;
    errors.largest = std::max(errors.largest, std::abs(error));
  }
  return errors;
}

void expect_small(PerforatedScreen const& screen) {
  for (DeviceChoice const views : {by_opengl, on_cpu}) {
    Errors const errors = over_the_year(screen, views);
    EXPECT_NEAR(errors.signed_mean, 0.0, 5e-4);
    EXPECT_LE(errors.mean, 1e-3);
    EXPECT_LE(errors.largest, 5e-3);
  }
}

TEST(PerforatedCase, OfAPatternIsWithinTheBounds) {
  PerforatedCase const given;
  expect_small(PerforatedScreen(given.pattern(), {given.thickness, given.plane}));
}

TEST(PerforatedCase, OfARasterIsWithinTheBounds) {
  PerforatedCase const given;
  expect_small(PerforatedScreen(OpacityTile(given.pattern(), given.hole / 64),
                                {given.thickness, given.plane}));
}

}  // namespace
}  // namespace gpu_shading
