// Rays through perforated sheets.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "gpu_shading/rays.h"
#include "gpu_shading/renderer.h"
#include "gpu_shading/transmittance.h"
#include "support/mean_of_rays.h"
#include "support/millimetre.h"
#include "support/perforated_case.h"
#include "support/shapes.h"
#include "support/sheet_cases.h"

namespace gpu_shading {
namespace {

HolePattern round_holes(double size, double pitch) {
  return HolePattern(
      {.hole = Hole::Round, .arrangement = Arrangement::Staggered60, .size = size, .pitch = pitch});
}

std::shared_ptr<PerforatedScreen const> screen_of(Sheet const& sheet,
                                                  HolePattern const& holes = round_holes(6 * mm,
                                                                                         9 * mm)) {
  return std::make_shared<PerforatedScreen const>(holes, sheet);
}

Surface sheet_surface(Polygon polygon, std::shared_ptr<PerforatedScreen const> screen) {
  Surface surface{"sheet", std::move(polygon)};
  surface.filter.set(PerforatedSheet{std::move(screen)});
  return surface;
}

Scene scene_of(Surface surface) {
  Scene scene;
  scene.add(std::move(surface));
  return scene;
}

TEST(ScreenRays, PassTheClosedFormOfTheirDirection) {
  HolePattern const holes = round_holes(6 * mm, 9 * mm);
  double const thickness = 2 * mm;
  RayScene const rays(
      scene_of(sheet_surface(level(-2, -2, 1, 4, 4), screen_of({.thickness = thickness}))));
  // u runs along y, v along -x, as in support/sheet_cases.h.
  for (double const tangent : {0.0, 0.3, 1.0, 2.5}) {
    for (double const turn : {0.0, 0.4, 2.0, 4.0}) {
      glm::dvec3 const direction(tangent * std::cos(turn), tangent * std::sin(turn), 1.0);
      double const expected =
          holes.transmittance(thickness * direction.y, -thickness * direction.x);
      for (double const x : {0.0, 0.0137, 0.02}) {
        glm::dvec3 const at(x, 0.1, 1.0);
        Ray const upwards{at - 1.5 * direction, direction};
        Ray const downwards{at + 1.5 * direction, -direction};
        EXPECT_NEAR(rays.transmittance(upwards), expected, 1e-12) << tangent << " " << turn;
        EXPECT_NEAR(rays.transmittance(downwards), expected, 1e-12) << tangent << " " << turn;
      }
    }
  }
  EXPECT_EQ(rays.transmittance({{-1.9, 0, 0}, {1, 0, 0.3}}), 0.0);      // beyond the cut-off
  EXPECT_EQ(rays.transmittance({{-3, 0, 0.9995}, {1, 0, 1e-4}}), 0.0);  // through its sides
  EXPECT_EQ(rays.transmittance({{-3, 0, 1}, {1, 0, 0}}), 1.0);          // in its plane
  EXPECT_EQ(rays.transmittance({{-3, 0, 1.0011}, {1, 0, 0}}), 1.0);
  EXPECT_EQ(rays.transmittance({{3, 0, 0}, {0, 0, 1}}), 1.0);
}

TEST(ScreenRays, CountDeploymentsSchedulesAndTransmittances) {
  Surface surface{"sheet", level(-2, -2, 1, 4, 4)};
  surface.filter.set(PerforatedSheet{screen_of({.thickness = 0.0}), {}, 1});
  surface.filter.schedule = 0;
  surface.filter.set(
      AngularTransmittance{std::make_shared<Transmittance const>(Transmittance::constant(0.8))});
  RayScene const rays(scene_of(surface));
  double const open = round_holes(6 * mm, 9 * mm).open_fraction();
  Ray const ray{{0, 0, 0}, {0, 0, 1}};
  EXPECT_NEAR(rays.transmittance(ray), 0.8 * open, 1e-12);
  std::array const deployments{0.0, 0.25};
  std::array const factors{0.5};
  RayConditions const conditions{.factors = factors, .deployments = deployments};
  EXPECT_NEAR(rays.transmittance(ray, conditions), 0.8 * 0.5 * (0.75 + 0.25 * open), 1e-12);
  EXPECT_FALSE(rays.nearest_opaque(ray, conditions));
  Ray const beyond_cut_off{{0, 0, 0}, {1.9, 0, 1}};
  Surface thick = surface;
  thick.filter.set(PerforatedSheet{screen_of({.thickness = 4 * mm}), {}, 1});
  auto const hit = RayScene(scene_of(thick)).nearest_opaque(beyond_cut_off);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, std::hypot(1.9, 1.0), 1e-9);
  EXPECT_FALSE(RayScene(scene_of(thick)).nearest_opaque(beyond_cut_off, conditions));
}

// The polygon is the outside face, and the body is below it.
TEST(ScreenRays, MeetThePolygonOrTheMiddleOfTheBody) {
  double const thickness = 4 * mm;
  RayScene const rays(scene_of(sheet_surface(
      level(-2, -2, 1, 4, 4), screen_of({.thickness = thickness, .plane = SheetPlane::outside}))));
  double const open = round_holes(6 * mm, 9 * mm).open_fraction();
  auto const upwards = [&](double z, double length) {
    return rays.transmittance({{0, 0, z}, {0, 0, 1}, length});
  };
  auto const downwards = [&](double z, double length) {
    return rays.transmittance({{0, 0, z}, {0, 0, -1}, length});
  };
  EXPECT_NEAR(downwards(1.0, 9), open, 1e-12);  // from the polygon
  EXPECT_NEAR(downwards(1.0, 0.003), open, 1e-12);
  EXPECT_EQ(downwards(1.0, 0.001), 1.0);
  EXPECT_EQ(downwards(1.0 - 3 * mm, 9), 1.0);
  EXPECT_EQ(upwards(1.0, 9), 1.0);
  EXPECT_NEAR(upwards(1.0 - 1 * mm, 9), open, 1e-12);
  EXPECT_EQ(upwards(0.0, 1.0 - 3 * mm), 1.0);
}

// An L and its lines of symmetry, on which its triangles meet.
TEST(ScreenRays, MeetASheetOfSeveralPiecesOnce) {
  Polygon const l{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, {}};
  for (auto const detail : {ScreenDetail::effective, ScreenDetail::holes}) {
    RayScene const rays(scene_of(sheet_surface(l, screen_of({.thickness = 2 * mm}))),
                        {.screens = detail});
    HolePattern const holes = round_holes(6 * mm, 9 * mm);
    for (int i = 1; i < 1000; ++i) {
      double const x = i / 1000.0;
      glm::dvec3 const slant(0.2, 0.1, 1.0);
      for (glm::dvec3 const& at : {glm::dvec3(x, x, 0), glm::dvec3(1.0, x, 0),
                                   glm::dvec3(x, 1.0, 0), glm::dvec3(x, 0.5, 0)}) {
        double const passed = rays.transmittance({at - slant, slant});
        if (detail == ScreenDetail::effective) {
          EXPECT_NEAR(passed, holes.transmittance(2 * mm * 0.1, 2 * mm * -0.2), 1e-9) << at.x;
        } else {
          EXPECT_TRUE(passed == 0.0 || passed == 1.0) << passed;
        }
      }
      EXPECT_EQ(rays.transmittance({glm::dvec3(1.0 + x, 1.1, 0) - slant, slant}), 1.0);
    }
  }
}

class ScreenRaysByHoles : public testing::TestWithParam<SheetForm> {};
INSTANTIATE_TEST_SUITE_P(Of, ScreenRaysByHoles,
                         testing::Values(SheetForm::pattern, SheetForm::image));

TEST_P(ScreenRaysByHoles, FollowTheRule) {
  for (SheetCase const& one : sheet_cases()) {
    Scene const scene = scene_of(sheet_of(one, GetParam()));
    // u runs along y, v along -x.
    glm::dvec3 const at(-one.place.y, one.place.x, 0.0);
    glm::dvec3 const direction = towards_sun_of(one);
    Ray const ray{at - direction, direction};
    EXPECT_EQ(RayScene(scene, {.screens = ScreenDetail::holes}).transmittance(ray), one.passed)
        << one.name;
    // The sheets' own detail.
    EXPECT_EQ(RayScene(scene, {.screens = ScreenDetail::automatic}).transmittance(ray), one.passed)
        << one.name;
  }
}

TEST(ScreenRays, HaveTheExactAnswerAsTheirMean) {
  PerforatedCase const given;
  PerforatedReference const reference(given);
  auto const screen = std::make_shared<PerforatedScreen const>(given.pattern(),
                                                               Sheet{given.thickness, given.plane});
  Scene const scene = given.scene(screen);
  RayScene const effective(scene);
  RayScene const by_holes(scene, {.screens = ScreenDetail::holes});
  for (auto const [azimuth, altitude] : {std::array{200.0, 60.0}, std::array{90.0, 50.0},
                                         std::array{10.0, 80.0}, std::array{250.0, 30.0}}) {
    SunDirection const sun = sun_at(azimuth, altitude);
    double const expected = reference(sun) / std::sin(sun.altitude);
    RayConditions const conditions{.receiver = 0};
    EXPECT_NEAR(mean_of_rays(effective, given.receiver, sun, conditions), expected, 1e-3);
    EXPECT_NEAR(mean_of_rays(by_holes, given.receiver, sun, conditions), expected, 4e-3);
  }
}

// Holes that grow from left to right, drawn hole by hole by the renderer, on a sheet with an
// opening in it that is not wholly deployed.
TEST(ScreenRays, HaveTheRenderersSunlitFractionAsTheirMean) {
  constexpr int columns = 1024;
  constexpr int rows = 512;
  std::vector<float> opacity;
  opacity.reserve(std::size_t{columns} * rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      double const radius = 4.0 + 10.0 * column / columns;
      double const x = column % 32 - 15.5;
      double const y = row % 32 - 15.5;
      opacity.push_back(x * x + y * y < radius * radius ? 0.0F : 1.0F);
    }
  }
  OpacityTile const tile(2.0, 1.0, columns, rows, opacity);
  auto const screen = std::make_shared<PerforatedScreen const>(tile, Sheet{.thickness = 20 * mm});
  ASSERT_GT(screen->transmittance().regions_across(), 1);
  Scene scene;
  scene.add({"receiver", level(0, 0, 0, 1.5, 1)});
  Polygon sheet = level(-0.5, -0.5, 0.6, 3, 2);
  sheet.holes = {level(0.2, 0.3, 0.6, 0.4, 0.3).outline};
  Surface surface{"sheet", sheet};
  surface.filter.set(PerforatedSheet{screen, {.rotation = 0.3}, 0});
  scene.add(surface);
  Renderer renderer = renderer_of(scene, 1024, on_cpu);
  std::array const deployments{0.8};
  renderer.set_deployments({deployments.begin(), deployments.end()});
  for (SunDirection const sun : {sun_at(170, 75), sun_at(250, 60), sun_at(20, 50)}) {
    double const rendered =
        sunlit(renderer, sun, 0).projected_area / (1.5 * std::sin(sun.altitude));
    RayConditions const conditions{.receiver = 0, .deployments = deployments};
    double const mean = mean_of_rays(RayScene(scene), scene[0].polygon, sun, conditions);
    EXPECT_NEAR(mean, rendered, 6e-3);
    EXPECT_NEAR(mean_of_rays(RayScene(scene, {.screens = ScreenDetail::holes}), scene[0].polygon,
                             sun, conditions),
                rendered, 4e-3);
    EXPECT_GT(rendered, 0.25);
    EXPECT_LT(rendered, 0.9);
  }
}

}  // namespace
}  // namespace gpu_shading
