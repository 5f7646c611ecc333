// Crowns of trees before receivers, against closed forms and integrals over their chords.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <random>

#include "each_backend.h"
#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"
#include "support/caster_kinds.h"
#include "support/crown_meshes.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

class CrownAreas : public EachBackend {};
INSTANTIATE_TEST_SUITE_P(By, CrownAreas, backends, name_of);

constexpr std::array some_suns{std::pair{150.0, 25.0}, std::pair{200.0, 48.0},
                               std::pair{95.0, 70.0}};

Surface crown_at(glm::dvec3 const& base, double width, double depth, Crown const& crown) {
  Surface surface{"crown", level(base.x - width / 2, base.y - depth / 2, base.z, width, depth)};
  surface.filter.set(crown);
  return surface;
}

SurfaceId add_ground(Scene& scene) { return scene.add({"ground", level(-50, -40, 0, 90, 80)}); }

// The area that a scene takes from its first surface, across the beam.
double area_in_shade(Renderer& renderer, SunDirection sun) {
  double const whole = area(renderer.scene()[0].polygon) *
                       glm::dot(normal(renderer.scene()[0].polygon), to_vector(sun));
  return whole - sunlit(renderer, sun, 0).projected_area;
}

double area_in_shade(Scene scene, SunDirection sun, DeviceChoice device, int resolution = 1024) {
  Renderer renderer = gpu_shading::renderer_of(std::move(scene), resolution, device);
  return area_in_shade(renderer, sun);
}

// Mean transmittance of a sphere over its disc, k being that of its diameter.
double through_sphere(double k) { return 2.0 * (1.0 - (1.0 + k) * std::exp(-k)) / (k * k); }

TEST_P(CrownAreas, SpheresFollowTheMeanOfChords) {
  for (double const density : {0.2, 1.0, 5.0}) {
    Scene scene;
    add_ground(scene);
    constexpr double radius = 3.0;
    scene.add(crown_at({1, 2, 2.5}, 2 * radius, 2 * radius,
                       {.height = 2 * radius, .leaf_density = density}));
    Renderer renderer = renderer_of(scene, 1024);
    double const stopped =
        pi * radius * radius * (1.0 - through_sphere(0.5 * density * 2.0 * radius));
    for (auto const& [azimuth, altitude] : some_suns) {
      EXPECT_NEAR(area_in_shade(renderer, sun_at(azimuth, altitude)) / stopped, 1.0, 3e-3)
          << density << ' ' << altitude;
    }
  }
}

// At the accuracy of a run, through a crown that shades all of a wall.
TEST_P(CrownAreas, DefaultAccuracyIsKept) {
  Scene scene;
  SurfaceId const wall = scene.add({"wall", south_facing(0, 0, 0, 3, 2)});
  constexpr double radius = 1.5;
  scene.add(crown_at({1.4, -2.0, 0.0}, 2 * radius, 2 * radius,
                     {.height = 2 * radius, .leaf_density = 1.0}));
  RendererOptions options;
  options.device = GetParam();
  Renderer renderer(scene, options);
  options.resolution = 4096;
  Renderer fine(std::move(scene), options);
  for (auto const& [azimuth, altitude] : some_suns) {
    SunDirection const sun = sun_at(azimuth, altitude);
    double const whole = 6.0 * glm::dot(glm::dvec3(0, -1, 0), to_vector(sun));
    EXPECT_NEAR(sunlit(renderer, sun, wall).projected_area / whole,
                sunlit(fine, sun, wall).projected_area / whole, 1e-3);
  }
}

TEST_P(CrownAreas, CylindersFollowTheirChords) {
  constexpr double radius = 2.0;
  constexpr double height = 5.0;
  constexpr double density = 0.6;
  Crown const crown{.shape = CrownShape::cylinder, .height = height, .leaf_density = density};
  Scene below;
  add_ground(below);
  below.add(crown_at({0, 0, 2}, 2 * radius, 2 * radius, crown));
  EXPECT_NEAR(area_in_shade(below, sun_at(180, 90), GetParam()) /
                  (pi * radius * radius * (1.0 - std::exp(-0.5 * density * height))),
              1.0, 3e-3);
  // From the horizon: chords of circles.
  Scene behind;
  behind.add({"wall", south_facing(-9, 6, -2, 18, 12)});
  behind.add(crown_at({0.3, 0, 1}, 2 * radius, 2 * radius, crown));
  double stopped = 0.0;
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    double const x = radius * (2.0 * (i + 0.5) / steps - 1.0);
    stopped += 1.0 - std::exp(-0.5 * density * 2.0 * std::sqrt(radius * radius - x * x));
  }
  stopped *= 2.0 * radius / steps * height;
  EXPECT_NEAR(area_in_shade(behind, sun_at(190, 0), GetParam()) / stopped, 1.0, 3e-3);
}

// What a solid stops, by points across the beam and along it; `is_inside` is of its box, whose
// sides are 2.
double stopped_by_points(glm::dvec3 const& half, SunDirection sun, double extinction,
                         std::function<bool(glm::dvec3 const&)> const& is_inside) {
  glm::dvec3 const s = to_vector(sun);
  glm::dvec3 const u = glm::normalize(glm::cross(s, glm::dvec3(0.3, 0.4, 0.86)));
  glm::dvec3 const v = glm::cross(s, u);
  double const reach = glm::length(half);
  constexpr int across = 160;
  constexpr int along = 400;
  double stopped = 0.0;
  for (int i = 0; i < across; ++i) {
    for (int k = 0; k < across; ++k) {
      glm::dvec3 const p =
          reach * ((2.0 * (i + 0.5) / across - 1.0) * u + (2.0 * (k + 0.5) / across - 1.0) * v);
      int inside = 0;
      for (int n = 0; n < along; ++n) {
        glm::dvec3 const q = p + reach * (2.0 * (n + 0.5) / along - 1.0) * s;
        if (is_inside(q / half)) ++inside;
      }
      stopped += 1.0 - std::exp(-extinction * 2.0 * reach * inside / along);
    }
  }
  return stopped * std::pow(2.0 * reach / across, 2);
}

TEST_P(CrownAreas, OtherShapesFollowTheirPoints) {
  struct Case {
    CrownShape shape;
    std::function<bool(glm::dvec3 const&)> is_inside;
  };
  auto const radius = [](glm::dvec3 const& p) { return std::hypot(p.x, p.y); };
  auto const up = [](glm::dvec3 const& p) { return 0.5 * (p.z + 1.0); };
  std::vector<Case> const cases{
      {CrownShape::ellipsoid, [](glm::dvec3 const& p) { return glm::dot(p, p) <= 1.0; }},
      {CrownShape::cone,
       [&](glm::dvec3 const& p) { return std::abs(p.z) <= 1.0 && radius(p) <= 1.0 - up(p); }},
      {CrownShape::half_ellipsoid,
       [&](glm::dvec3 const& p) { return p.z >= -1.0 && std::hypot(radius(p), up(p)) <= 1.0; }},
  };
  glm::dvec3 const half(2.0, 1.5, 3.0);
  for (Case const& each : cases) {
    Scene scene;
    add_ground(scene);
    scene.add(crown_at(
        {0, 0, 1}, 2 * half.x, 2 * half.y,
        {.shape = each.shape, .height = 2 * half.z, .leaf_density = 0.7, .wood_density = 0.1}));
    for (auto const& [azimuth, altitude] : some_suns) {
      SunDirection const sun = sun_at(azimuth, altitude);
      double const expected = stopped_by_points(half, sun, 0.5 * 0.8, each.is_inside);
      EXPECT_NEAR(area_in_shade(scene, sun, GetParam()) / expected, 1.0, 8e-3)
          << static_cast<int>(each.shape) << ' ' << altitude;
    }
  }
}

// A mesh of 14,160 triangles in an ellipsoid, also where a roof cuts it.
TEST_P(CrownAreas, FineMeshesAreAsTheirShape) {
  for (double const roof : {0.0, 4.2}) {
    auto const stopped = [&](Crown const& crown, SunDirection sun) {
      Scene scene;
      scene.add({"roof", level(-20, -20, roof, 40, 40)});
      scene.add(crown_at({0.5, 0.2, 1.0}, 4.0, 3.0, crown));
      return area_in_shade(std::move(scene), sun, GetParam());
    };
    for (auto const& [azimuth, altitude] : some_suns) {
      SunDirection const sun = sun_at(azimuth, altitude);
      Crown crown{.height = 6.0, .leaf_density = 0.9, .wood_density = 0.1};
      double const expected = stopped(crown, sun);
      crown.shape = CrownShape::mesh;
      crown.mesh = ball_mesh(120);
      EXPECT_NEAR(stopped(crown, sun) / expected, 1.0, 3e-3) << roof << ' ' << altitude;
    }
  }
}

// From the zenith and from the south, a box is what its sides say.
TEST_P(CrownAreas, MeshesOfBoxesAreInClosedForm) {
  constexpr double density = 0.7;
  Scene scene;
  add_ground(scene);
  scene.add(crown_at({0, 0, 2}, 4, 3,
                     {.shape = CrownShape::mesh,
                      .height = 5,
                      .leaf_density = density,
                      .mesh = std::make_shared<CrownMesh const>(
                          box_triangles(glm::dvec3(-1.0), glm::dvec3(1.0)))}));
  EXPECT_NEAR(area_in_shade(scene, sun_at(180, 90), GetParam(), 4096) /
                  (4.0 * 3.0 * (1.0 - std::exp(-0.5 * density * 5.0))),
              1.0, 3e-3);
  // At 45 degrees: through the whole depth in the middle, less towards both ends.
  double const through = 3.0 * std::sqrt(2.0);
  double const k = 0.5 * density;
  double const slope = through - (1.0 - std::exp(-k * through)) / k;
  double const expected =
      4.0 * ((5.0 - 3.0) * std::sqrt(0.5) * (1.0 - std::exp(-k * through)) + slope);
  EXPECT_NEAR(area_in_shade(scene, sun_at(180, 45), GetParam(), 4096) / expected, 1.0, 3e-3);
}

// A roof through the middle of a crown: the half above it counts.
TEST_P(CrownAreas, TheReceiversPlaneCutsThem) {
  Scene scene;
  scene.add({"roof", level(-20, -20, 5, 40, 40)});
  constexpr double radius = 3.0;
  scene.add(crown_at({0.5, 0.2, 2.0}, 2 * radius, 2 * radius,
                     {.height = 2 * radius, .leaf_density = 0.9}));
  double const stopped = pi * radius * radius * (1.0 - through_sphere(0.5 * 0.9 * radius));
  EXPECT_NEAR(area_in_shade(scene, sun_at(180, 90), GetParam()) / stopped, 1.0, 3e-3);
  // One that is behind the plane does not.
  scene.add(crown_at({9, 0.2, 0.0}, 2 * radius, 2 * radius, {.height = 4.9}));
  EXPECT_NEAR(area_in_shade(scene, sun_at(180, 90), GetParam()) / stopped, 1.0, 3e-3);
}

// Cylinders one above the other, and other casters across all of one.
TEST_P(CrownAreas, Multiply) {
  constexpr double radius = 2.0;
  Crown const crown{.shape = CrownShape::cylinder, .height = 3.0, .leaf_density = 0.5};
  double const one = std::exp(-0.5 * 0.5 * 3.0);
  auto const kept = [&](std::vector<Surface> const& others, double outside) {
    Scene scene;
    add_ground(scene);
    scene.add(crown_at({0, 0, 2}, 2 * radius, 2 * radius, crown));
    for (Surface const& other : others) scene.add(other);
    double const disc = pi * radius * radius;
    double const beside = 90.0 * 80.0 - disc;
    double const lit = 90.0 * 80.0 - area_in_shade(std::move(scene), sun_at(180, 90), GetParam());
    return (lit - outside * beside) / disc;
  };
  EXPECT_NEAR(kept({}, 1.0), one, 5e-3);
  EXPECT_NEAR(kept({crown_at({0, 0, 6}, 2 * radius, 2 * radius, crown)}, 1.0), one * one, 5e-3);
  Surface pane{"pane", level(-60, -60, 8, 120, 120)};
  pane.filter.set(
      AngularTransmittance{std::make_shared<Transmittance const>(Transmittance::constant(0.4))});
  EXPECT_NEAR(kept({pane}, 0.4), 0.4 * one, 5e-3);
  Surface screen{"screen", level(-60, -60, 8, 120, 120)};
  auto const mesh = std::make_shared<PerforatedScreen const>(
      HolePattern(
          {.hole = Hole::Square, .arrangement = Arrangement::Straight, .size = 0.05, .pitch = 0.1}),
      Sheet{.thickness = 0.001, .detail = ScreenDetail::effective});
  screen.filter.set(PerforatedSheet{mesh});
  EXPECT_NEAR(kept({screen}, 0.25), 0.25 * one, 5e-3);
  Surface slab{"slab", level(-60, -60, 8, 120, 120)};
  EXPECT_NEAR(kept({slab}, 0.0), 0.0, 1e-9);
}

// Leaves that are drawn one by one stop as much as their density says.
TEST_P(CrownAreas, LeavesOneByOneStopAsMuch) {
  constexpr double radius = 2.5;
  constexpr int leaves = 20000;
  constexpr double side = 0.05;
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Scene tree;
  add_ground(tree);
  for (int i = 0; i < leaves;) {
    glm::dvec3 const p(uniform(engine), uniform(engine), uniform(engine));
    if (glm::dot(p, p) > 1.0) continue;
    auto const random = [&] {
      return glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine)));
    };
    glm::dvec3 const a = random();
    glm::dvec3 const b = glm::normalize(glm::cross(a, random()));
    glm::dvec3 const middle = glm::dvec3(0, 0, 2 + radius) + radius * p;
    tree.add({"leaf", parallelogram(middle - 0.5 * side * (a + b), side * a, side * b)});
    ++i;
  }
  double const density = leaves * side * side / (4.0 / 3.0 * pi * std::pow(radius, 3));
  double const stopped = pi * radius * radius * (1.0 - through_sphere(density * radius));
  Renderer renderer = renderer_of(std::move(tree), 4096);
  // Each takes half of its side beyond the solid's edge, 1 % of the radius, which is thin there.
  for (auto const& [azimuth, altitude] : some_suns) {
    EXPECT_NEAR(area_in_shade(renderer, sun_at(azimuth, altitude)) / stopped, 1.0, 0.02);
  }
}

// Interiors behind a window that a crown shades as a whole.
TEST_P(CrownAreas, ShadeWhatIsBehindWindows) {
  Scene scene;
  SurfaceId const window = scene.add({"window", south_facing(0, 0, 1, 2, 1)});
  SurfaceId const floor = scene.add({"floor", level(-40, 0, 0, 80, 40)});
  scene.add(crown_at({1, -30, -40}, 40, 40,
                     {.shape = CrownShape::cylinder, .height = 80, .leaf_density = 0.05}));
  Renderer renderer = renderer_of(scene, 512);
  std::vector<SurfaceId> const interiors{floor};
  SunDirection const sun = sun_at(180, 35);
  double const behind = renderer.interior_sunlit_areas(sun, window, interiors)[0].projected_area;
  EXPECT_NEAR(behind / sunlit(renderer, sun, window).projected_area, 1.0, 1e-5);
  EXPECT_LT(behind, 1.5);
}

}  // namespace
}  // namespace gpu_shading
