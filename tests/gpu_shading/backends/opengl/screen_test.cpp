#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "backends/open_backend.h"
#include "each_backend.h"
#include "gpu_shading/image.h"
#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"
#include "render/renderer_with_backend.h"
#include "support/millimetre.h"
#include "support/pixels_on_cpu.h"
#include "support/random_scene.h"
#include "support/regular_shades.h"
#include "support/regular_sheets.h"
#include "support/room.h"
#include "support/shapes.h"

// Perforated sheets as the renderer draws and counts them, against what is known of them in closed
// form.
namespace gpu_shading {
namespace {

using Screen = std::shared_ptr<PerforatedScreen const>;

HolePattern round_holes(double size, double pitch) {
  return HolePattern(
      {.hole = Hole::Round, .arrangement = Arrangement::Staggered60, .size = size, .pitch = pitch});
}

HolePattern square_holes(double size, double pitch) {
  return HolePattern(
      {.hole = Hole::Square, .arrangement = Arrangement::Straight, .size = size, .pitch = pitch});
}

// By OpenGL alone, also where it leaves views to the CPU.
Renderer drawing_pixels(Scene scene, int resolution) {
  RendererOptions options;
  options.resolution = resolution;
  options.samples_only = true;
  return RendererWithBackend::make(std::move(scene), options, [](BackendInput const& input) {
    return open_backend(input, by_opengl);
  });
}

Screen sheet_of(HolePattern const& holes, double thickness,
                ScreenDetail detail = ScreenDetail::holes) {
  Sheet sheet{.thickness = thickness};
  sheet.detail = detail;
  return std::make_shared<PerforatedScreen const>(holes, sheet);
}

Screen sheet_of(OpacityTile tile, double thickness, ScreenDetail detail = ScreenDetail::holes) {
  Sheet sheet{.thickness = thickness};
  sheet.detail = detail;
  return std::make_shared<PerforatedScreen const>(std::move(tile), sheet);
}

Surface screened(std::string name, Polygon polygon, Screen screen, ScreenPlacement placement = {}) {
  Surface surface{std::move(name), std::move(polygon)};
  surface.filter.set(PerforatedSheet{std::move(screen), placement});
  return surface;
}

// A level receiver of 7 x 12 tiles, over which the mean is the tile's wherever it begins, below a
// sheet that covers the sun's way to all of it. The sheet's second edge, along which is u, runs
// north.
Scene covered(double tile_width, double tile_height, Screen screen) {
  Scene scene;
  scene.add({"receiver", level(0, 0, 0, 7 * tile_height, 12 * tile_width)});
  scene.add(screened("screen", level(-2, -2, 0.1, 5, 5), std::move(screen)));
  return scene;
}

double passed(Renderer& renderer, SunDirection sun, SurfaceId receiver = 0) {
  double const whole = area(renderer.scene()[receiver].polygon) *
                       glm::dot(normal(renderer.scene()[receiver].polygon), to_vector(sun));
  return sunlit(renderer, sun, receiver).projected_area / whole;
}

double closed_form(HolePattern const& holes, double thickness, SunDirection sun) {
  glm::dvec3 const s = to_vector(sun);
  return holes.transmittance(thickness * s.y / s.z, -thickness * s.x / s.z);
}

class Screened : public EachBackend {};
INSTANTIATE_TEST_SUITE_P(Is, Screened, backends, name_of);

constexpr double altitudes[] = {90.0, 75.0, 60.0, 45.0, 35.0};

TEST_P(Screened, OfHolesLetsTheClosedFormThrough) {
  double const thickness = 30 * mm;
  for (Hole const hole : {Hole::Round, Hole::Square, Hole::Hexagonal}) {
    HolePattern const holes({.hole = hole, .size = 50 * mm, .pitch = 80 * mm});
    for (auto const detail : {ScreenDetail::holes, ScreenDetail::effective}) {
      Renderer renderer = renderer_of(
          covered(holes.width(), holes.height(), sheet_of(holes, thickness, detail)), 1024);
      for (double const altitude : altitudes) {
        SunDirection const sun = sun_at(33.0, altitude);
        EXPECT_NEAR(passed(renderer, sun), closed_form(holes, thickness, sun),
                    detail == ScreenDetail::holes ? 2e-4 : 1e-6)
            << static_cast<int>(hole) << " altitude " << altitude;
      }
    }
  }
}

TEST_P(Screened, OfARasterLetsWhatItsHolesDoThrough) {
  double const thickness = 30 * mm;
  HolePattern const holes = round_holes(50 * mm, 80 * mm);
  for (auto const detail : {ScreenDetail::holes, ScreenDetail::effective}) {
    Renderer renderer =
        renderer_of(covered(holes.width(), holes.height(),
                            sheet_of(OpacityTile(holes, 1 * mm), thickness, detail)),
                    1024);
    for (double const altitude : altitudes) {
      SunDirection const sun = sun_at(33.0, altitude);
      EXPECT_NEAR(passed(renderer, sun), closed_form(holes, thickness, sun), 4e-3)
          << static_cast<int>(detail) << " altitude " << altitude;
    }
  }
}

// Ten layers of a thick sheet leave gaps under low sun, which its walls close.
TEST_P(Screened, OfFewLayersLeaksWhereASheetDoesNot) {
  HolePattern const holes = round_holes(50 * mm, 52 * mm);
  SunDirection const sun = sun_at(33.0, 15.0);
  Sheet sheet{.thickness = 100 * mm};
  Renderer exact = renderer_of(covered(holes.width(), holes.height(), sheet_of(holes, 100 * mm)));
  EXPECT_EQ(passed(exact, sun), 0.0);
  sheet.layers = 3;
  sheet.detail = ScreenDetail::holes;
  Renderer leaking = renderer_of(covered(holes.width(), holes.height(),
                                         std::make_shared<PerforatedScreen const>(holes, sheet)));
  EXPECT_GT(passed(leaking, sun), 0.1);
  sheet.layers = 64;
  Renderer closed = renderer_of(covered(holes.width(), holes.height(),
                                        std::make_shared<PerforatedScreen const>(holes, sheet)));
  EXPECT_EQ(passed(closed, sun), 0.0);
}

// Wider than a layer of a texture may be, so that it is cut into two: a bar of open texels at the
// seam and one at the image's ends.
TEST_P(Screened, OfALargeImageIsWhole) {
  constexpr int columns = 6000;
  std::vector<float> opacity(columns, 1.0F);
  for (int i = 4000; i < 4200; ++i) opacity[static_cast<std::size_t>(i)] = 0.0F;
  for (int i = 0; i < 100; ++i) opacity[static_cast<std::size_t>(i)] = 0.0F;
  for (int i = 5900; i < 6000; ++i) opacity[static_cast<std::size_t>(i)] = 0.0F;
  Scene scene;
  // u runs north from the sheet's south-east corner.
  for (double const y : {0.0, 3.0, 4.0, 4.1, 4.15, 4.2, 5.8, 5.92}) {
    scene.add({"strip", level(1, y, 0, 1, 0.05)});
  }
  scene.add(screened("screen", level(0, 0, 1, 3, 6),
                     sheet_of(OpacityTile(6.0, 1.0, columns, 1, opacity), 0.0)));
  Renderer renderer = renderer_of(scene, 64);
  std::vector<double> shares;
  for (SurfaceId id = 0; id < 8; ++id) {
    shares.push_back(std::round(passed(renderer, sun_at(0, 90), id) * 100) / 100);
  }
  EXPECT_EQ(shares, (std::vector<double>{1, 0, 1, 1, 1, 0, 0, 1}));
}

// Bars of 8 texels in every 16, of 4, and so on, from west to east: what passes is another from
// place to place, and the same whether bars are drawn or their effect.
TEST_P(Screened, OfAnImageThatVariesHasItsEffectInPlace) {
  constexpr int side = 1024;
  std::vector<float> opacity;
  for (int row = 0; row < side; ++row) {
    int const solid = 16 - 4 * (1 + row / 512);  // u runs north, v west: rows are from east to west
    for (int column = 0; column < side; ++column) {
      opacity.push_back(column % 16 < solid ? 1.0F : 0.0F);
    }
  }
  OpacityTile const tile(4.0, 4.0, side, side, opacity);
  for (ScreenDetail const detail : {ScreenDetail::holes, ScreenDetail::effective}) {
    Scene scene;
    scene.add({"west", level(0.5, 1, 0, 0.5, 2)});
    scene.add({"east", level(3.0, 1, 0, 0.5, 2)});
    scene.add(screened("screen", level(0, 0, 0.5, 4, 4), sheet_of(tile, 0.01, detail)));
    Renderer renderer = renderer_of(scene, 1024);
    for (SunDirection const sun : {sun_at(0, 90), sun_at(0, 70), sun_at(90, 70)}) {
      // Bars run from east to west; across them the walls take tan(theta) x thickness.
      glm::dvec3 const s = to_vector(sun);
      double const lost = 0.01 * std::abs(s.y) / s.z;
      double const cell = 4.0 / 64;
      EXPECT_NEAR(passed(renderer, sun, 0), 0.5 - lost / cell, 0.01);
      EXPECT_NEAR(passed(renderer, sun, 1), 0.25 - lost / cell, 0.01);
    }
  }
}

// Small pixels see holes, large ones their effect, and what is between, something between.
TEST_P(Screened, IsDrawnAsTheSizeOfPixelsAsks) {
  HolePattern const holes = round_holes(50 * mm, 80 * mm);
  OpacityTile const small(holes, 2 * mm);
  // A tile of more than one region.
  std::vector<float> stripes;
  stripes.reserve(std::size_t{512} * 512);
  for (int i = 0; i < 512 * 512; ++i) stripes.push_back(i % 32 < 12 ? 1.0F : 0.0F);
  OpacityTile const large(0.8, 0.8, 512, 512, stripes);
  SunDirection const sun = sun_at(33.0, 60.0);
  for (int kind = 0; kind < 3; ++kind) {
    auto const answer = [&](ScreenDetail detail, int resolution) {
      Screen const screen = kind == 0   ? sheet_of(holes, 30 * mm, detail)
                            : kind == 1 ? sheet_of(small, 30 * mm, detail)
                                        : sheet_of(large, 10 * mm, detail);
      Renderer renderer = renderer_of(covered(holes.width(), holes.height(), screen), resolution);
      return passed(renderer, sun);
    };
    EXPECT_EQ(answer(ScreenDetail::automatic, 512), answer(ScreenDetail::holes, 512)) << kind;
    EXPECT_EQ(answer(ScreenDetail::automatic, 4), answer(ScreenDetail::effective, 4)) << kind;
    EXPECT_NE(answer(ScreenDetail::effective, 512), answer(ScreenDetail::holes, 512)) << kind;
  }
}

// One slot, 0.2 m wide and 1 m long, and small receivers below where it should be and where not.
struct Slot {
  Polygon sheet;
  ScreenPlacement placement;
  glm::dvec2 lit;
  glm::dvec2 dark;
};

TEST_P(Screened, LiesWhereItIsPlaced) {
  HolePattern const slot({.hole = Hole::Slotted,
                          .arrangement = Arrangement::Straight,
                          .size = 0.2,
                          .length = 1.0,
                          .pitch = 20.0});
  // Its second vertex is (4, 0), from which u runs north and v west.
  Polygon const up = level(0, 0, 1, 4, 3);
  // And of its mirror image (4, 3), from which u runs south and v west: it looks down, so that the
  // receiver sees its outside.
  Polygon const down{{{0, 3, 1}, {4, 3, 1}, {4, 0, 1}, {0, 0, 1}}, {}};
  double const turn = 45 * degree;
  Slot const cases[] = {
      {up, {0.5, 1.0, 0.0}, {3.0, 0.9}, {2.6, 0.5}},
      {up, {0.5, 1.0, 90 * degree}, {2.6, 0.5}, {3.0, 0.9}},
      {up, {0.5, 1.0, turn}, {2.75, 0.75}, {3.25, 0.75}},
      {down, {0.5, 1.0, 0.0}, {3.0, 2.1}, {2.6, 2.5}},
      {down, {0.5, 1.0, turn}, {2.75, 2.25}, {3.25, 2.25}},
  };
  for (Slot const& one : cases) {
    Scene scene;
    scene.add({"lit", level(one.lit.x - 0.03, one.lit.y - 0.03, 0, 0.06, 0.06)});
    scene.add({"dark", level(one.dark.x - 0.03, one.dark.y - 0.03, 0, 0.06, 0.06)});
    scene.add(screened("screen", one.sheet, sheet_of(slot, 0.01), one.placement));
    Renderer renderer = renderer_of(scene, 64);
    EXPECT_EQ(passed(renderer, sun_at(0, 90), 0), 1.0) << &one - cases;
    EXPECT_EQ(passed(renderer, sun_at(0, 90), 1), 0.0) << &one - cases;
  }
}

// A solid sheet is a block: from the side it covers its height times its length, and more than its
// polygon from everywhere else, above or below it as its plane is.
TEST_P(Screened, HasTheThicknessOfItsSides) {
  HolePattern const far_apart = square_holes(0.01, 50.0);
  for (SheetPlane const plane : {SheetPlane::centre, SheetPlane::outside, SheetPlane::inside}) {
    Sheet sheet{.thickness = 0.2, .plane = plane};
    auto const screen = std::make_shared<PerforatedScreen const>(far_apart, sheet);
    double const bottom = plane == SheetPlane::inside    ? 1.0
                          : plane == SheetPlane::outside ? 0.8
                                                         : 0.9;
    Scene scene;
    scene.add({"wall", south_facing(0, 2, 0, 4, 4), Casting::never});
    scene.add({"ground", level(0, -10, 0, 4, 30)});
    // Its hole lies outside it.
    scene.add(screened("sheet", level(1, 0, 1, 2, 1), screen, {20.0, 20.0, 0.0}));
    Renderer renderer = renderer_of(scene);
    EXPECT_NEAR(passed(renderer, sun_at(180, 0), 0), 1.0 - 0.2 * 2.0 / 16.0, 1e-3);
    // At 45 degrees from the south the block's shadow on the ground is 1 m deep, and its height.
    EXPECT_NEAR(passed(renderer, sun_at(180, 45), 1), 1.0 - 2.0 * 1.2 / 120.0, 1e-3);
    // On the wall, 2 m behind its front, it shades what is below the ray over its upper edge.
    Scene low = scene;
    low.add({"band", south_facing(1.5, 2, bottom - 0.05, 1, 0.04)});
    low.add({"block", south_facing(1.5, 2, bottom + 0.01, 1, 0.18)});
    Renderer close = renderer_of(low, 64);
    EXPECT_EQ(passed(close, sun_at(180, 0), 3), 1.0);
    EXPECT_EQ(passed(close, sun_at(180, 0), 4), 0.0);
  }
}

// A sheet that lies on its receiver shades it by its body, if that is on the outside.
TEST_P(Screened, OnItsReceiverCastsItsThickness) {
  HolePattern const holes = square_holes(50 * mm, 80 * mm);
  double const thickness = 30 * mm;
  auto const scene_with = [&](Polygon polygon, SheetPlane plane, ScreenDetail detail) {
    Sheet sheet{.thickness = thickness, .plane = plane};
    sheet.detail = detail;
    Scene scene;
    scene.add({"receiver", level(0, 0, 0, 7 * holes.height(), 12 * holes.width())});
    scene.add(screened("screen", std::move(polygon),
                       std::make_shared<PerforatedScreen const>(holes, sheet)));
    return scene;
  };
  Polygon const up = level(-2, -2, 0, 5, 5);
  Polygon down = up;
  std::reverse(down.outline.begin(), down.outline.end());
  for (auto const detail : {ScreenDetail::holes, ScreenDetail::effective}) {
    Renderer above = renderer_of(scene_with(up, SheetPlane::inside, detail), 1024);
    Renderer turned = renderer_of(scene_with(down, SheetPlane::outside, detail), 1024);
    Renderer below = renderer_of(scene_with(up, SheetPlane::outside, detail), 1024);
    for (double const altitude : altitudes) {
      SunDirection const sun = sun_at(33.0, altitude);
      double const expected = closed_form(holes, thickness, sun);
      EXPECT_NEAR(passed(above, sun), expected, 4e-4) << altitude;
      EXPECT_NEAR(passed(turned, sun), expected, 4e-4) << altitude;
      EXPECT_EQ(passed(below, sun), 1.0) << altitude;
    }
  }
}

// Rays from one piece into its neighbour pass both.
TEST_P(Screened, IsTheSameInPieces) {
  Screen const screen = sheet_of(round_holes(0.3, 0.4), 0.2);
  Screen const raster = sheet_of(OpacityTile(round_holes(0.3, 0.4), 0.01), 0.2);
  Polygon const ell{{{3, 0, 1}, {3, 1, 1}, {1, 1, 1}, {1, 3, 1}, {0, 3, 1}, {0, 0, 1}},
                    {}};  // u west, v south
  for (Screen const& one : {screen, raster}) {
    Scene whole;
    whole.add({"receiver", level(-1, -1, 0, 5, 5)});
    whole.add(screened("ell", ell, one));
    Scene parts;
    parts.add({"receiver", level(-1, -1, 0, 5, 5)});
    // Each begins with the corner before the ell's second vertex, or is placed as if it did.
    parts.add(screened("east", {{{3, 0, 1}, {3, 1, 1}, {1, 1, 1}, {1, 0, 1}}, {}}, one));
    parts.add(screened("west", {{{1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0, 0, 1}}, {}}, one,
                       {-2.0, 0.0, 0.0}));
    parts.add(screened("north", {{{1, 1, 1}, {1, 3, 1}, {0, 3, 1}, {0, 1, 1}}, {}}, one,
                       {-2.0, 2.0, 0.0}));
    Renderer in_one = renderer_of(whole);
    Renderer in_three = renderer_of(parts);
    for (SunDirection const sun : {sun_at(0, 90), sun_at(33, 60), sun_at(200, 35)}) {
      EXPECT_NEAR(passed(in_one, sun), passed(in_three, sun), 1e-4);
      EXPECT_LT(passed(in_one, sun), 0.95);
    }
  }
}

struct Mixed {
  HolePattern holes = square_holes(40 * mm, 80 * mm);
  Scene scene;
  SunDirection sun = sun_at(0, 90);

  Mixed() { scene.add({"receiver", level(0, 0, 0, 0.96, 0.96)}); }
  Polygon sheet(double height) const { return level(-2, -2, height, 5, 5); }
};

TEST_P(Screened, MixesWithAllOtherCasters) {
  Mixed mixed;
  mixed.scene.add(screened("screen", mixed.sheet(0.3), sheet_of(mixed.holes, 1 * mm)));
  double const quarter = 0.25;
  {
    Renderer renderer = renderer_of(mixed.scene, 1024);
    EXPECT_NEAR(passed(renderer, mixed.sun), quarter, 3e-4);
  }
  // Half of it behind an opaque sheet, above or below the screen.
  for (double const height : {0.2, 0.4}) {
    Scene scene = mixed.scene;
    scene.add({"opaque", level(-2, -2, height, 2.48, 5)});
    Renderer renderer = renderer_of(scene, 1024);
    EXPECT_NEAR(passed(renderer, mixed.sun), quarter / 2, 3e-4);
  }
  // Glass before it and glass behind it.
  Scene glazed = mixed.scene;
  auto const glass = std::make_shared<Transmittance const>(Transmittance::constant(0.5));
  glazed.add({"above", mixed.sheet(0.4), Casting::always, {{AngularTransmittance{glass}}}});
  glazed.add({"below", mixed.sheet(0.2), Casting::always, {{AngularTransmittance{glass}}}});
  Renderer through_glass = renderer_of(glazed, 1024);
  EXPECT_NEAR(passed(through_glass, mixed.sun), quarter / 4, 1e-4);
  // A second screen, hole over hole, and displaced by a hole.
  for (double const origin : {0.0, 40 * mm}) {
    Scene scene = mixed.scene;
    scene.add(
        screened("second", mixed.sheet(0.5), sheet_of(mixed.holes, 1 * mm), {origin, origin, 0.0}));
    Renderer renderer = renderer_of(scene, 1024);
    EXPECT_NEAR(passed(renderer, mixed.sun), origin == 0.0 ? quarter : 0.0, 3e-4);
  }
  // And as textures, two different ones.
  Scene textures = mixed.scene;
  textures.add(
      screened("stripes", mixed.sheet(0.5),
               sheet_of(OpacityTile(0.01, 0.01, 2, 1, std::vector<float>{0.0F, 1.0F}), 0.0)));
  textures.add(
      screened("grey", mixed.sheet(0.6),
               sheet_of(OpacityTile(1, 1, 1, 1, std::vector<float>{0.4F}, std::nullopt), 0.0)));
  Renderer through_textures = renderer_of(textures, 1024);
  EXPECT_NEAR(passed(through_textures, mixed.sun), quarter * 0.5 * 0.6, 1e-3);
}

// The fraction counts once, whatever the layers.
TEST_P(Screened, OfFractionalOpacityMultiplies) {
  Scene scene;
  scene.add({"receiver", level(0, 0, 0, 1, 1)});
  scene.add(
      screened("screen", level(-2, -2, 0.3, 5, 5),
               sheet_of(OpacityTile(1, 1, 1, 1, std::vector<float>{0.4F}, std::nullopt), 0.05)));
  Renderer renderer = renderer_of(scene);
  for (double const altitude : altitudes) {
    EXPECT_NEAR(passed(renderer, sun_at(20, altitude)), 0.6, 1e-4);
  }
}

// Every kind of screen on every kind of polygon, some of them through the receiver's plane.
TEST(CountedScreens, AreAsDrawn) {
  Perforation const staggered{.hole = Hole::Round, .size = 0.12, .pitch = 0.17};
  Perforation const slots{.hole = Hole::Slotted,
                          .arrangement = Arrangement::Straight,
                          .size = 0.05,
                          .length = 0.3,
                          .pitch = 0.4,
                          .row_pitch = 0.1};
  Perforation const squares{
      .hole = Hole::Square, .arrangement = Arrangement::Straight, .size = 0.06, .pitch = 0.1};
  Perforation const hexagons{.hole = Hole::Hexagonal, .size = 0.03, .pitch = 0.04};
  constexpr std::size_t side = 300;
  std::vector<float> ramp(side * side);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<float>(i % side) / side;
  std::vector<Screen> screens;
  for (auto const& perforation : {staggered, slots, squares, hexagons}) {
    HolePattern const holes(perforation);
    for (auto const detail :
         {ScreenDetail::automatic, ScreenDetail::holes, ScreenDetail::effective}) {
      screens.push_back(sheet_of(holes, 20 * mm, detail));
    }
    screens.push_back(
        std::make_shared<PerforatedScreen const>(holes, Sheet{50 * mm, SheetPlane::outside, 5}));
    screens.push_back(sheet_of(OpacityTile(holes, 5 * mm), 15 * mm));
  }
  for (auto const detail : {ScreenDetail::automatic, ScreenDetail::effective}) {
    screens.push_back(sheet_of(OpacityTile(2, 2, 300, 300, ramp), 30 * mm, detail));
    screens.push_back(sheet_of(OpacityTile(2, 2, 300, 300, ramp, std::nullopt), 10 * mm, detail));
  }
  double sum = 0.0;
  double worst = 0.0;
  constexpr std::uint32_t scenes = 64;
  for (std::uint32_t seed = 1; seed <= scenes; ++seed) {
    RandomScene const random = random_scene(seed);
    Scene scene;
    for (SurfaceId id = 0; id < random.scene.size(); ++id) {
      Surface surface = random.scene[id];
      PerforatedSheet sheet{screens[(seed + 5 * id) % screens.size()]};
      if (id % 4 == 2) sheet.deployment = 0;
      if (id % 4 != 0) surface.filter.set(sheet);
      scene.add(surface);
    }
    double const whole =
        area(scene[0].polygon) * glm::dot(normal(scene[0].polygon), to_vector(random.sun));
    double lit[2];
    for (DeviceChoice const how : {by_opengl, on_cpu}) {
      Renderer renderer = how == on_cpu ? counting_pixels(scene, 256) : drawing_pixels(scene, 256);
      renderer.set_deployments({0.7});
      lit[how == on_cpu ? 1 : 0] = sunlit(renderer, random.sun, 0).projected_area / whole;
    }
    double const difference = std::abs(lit[1] - lit[0]);
    EXPECT_LE(difference, 2e-4) << seed;
    sum += difference;
    worst = std::max(worst, difference);
  }
  std::printf("counted and drawn differ by %.1e in the mean, %.1e at most\n", sum / scenes, worst);
  EXPECT_LE(sum / scenes, 3e-5);
  EXPECT_GT(worst, 0.0);  // they are two
}

// Effective transmittances, multiplied, are up to 0.09 off.
TEST(TwoScreens, OfHolesSmallerThanPixelsAreRightByOpenGl) {
  std::mt19937 generator(7);
  std::vector<SunDirection> const suns = spread_suns(5);
  double worst = 0.0;
  for (int i = 0; i < 8; ++i) {
    RegularSheets const sheets(0.3, 0.21, random_pair(generator, i));
    RendererOptions options;
    options.device = by_opengl;
    Renderer renderer(sheets.scene(), options);
    double seconds = 0.0;
    for (double const error : errors_behind(sheets, renderer, suns, seconds)) {
      worst = std::max(worst, error);
    }
  }
  std::printf("largest error %.1e\n", worst);
  EXPECT_LE(worst, 2e-3);
}

TEST_P(Screened, WithAScheduleIsKeptApart) {
  Mixed mixed;
  Surface scheduled = screened("screen", mixed.sheet(0.3), sheet_of(mixed.holes, 1 * mm));
  scheduled.filter.schedule = 0;
  mixed.scene.add(scheduled);
  Renderer renderer = renderer_of(mixed.scene, 1024);
  Sunlit const got = sunlit(renderer, mixed.sun, 0);
  double const whole = 0.96 * 0.96;
  EXPECT_NEAR(got.projected_area, 0.0, 1e-9);
  EXPECT_NEAR(got.at(std::vector<double>{1.0}) / whole, 0.25, 3e-4);
  EXPECT_NEAR(got.at(std::vector<double>{0.2}) / whole, 0.05, 3e-4);
}

TEST_P(Screened, ThatSlidesAwayLetsTheRestPass) {
  Mixed mixed;
  Surface sliding = screened("screen", mixed.sheet(0.3), sheet_of(mixed.holes, 1 * mm));
  PerforatedSheet sheet = *sliding.filter.find<PerforatedSheet>();
  sheet.deployment = 1;
  sliding.filter.set(sheet);
  mixed.scene.add(sliding);
  Renderer renderer = renderer_of(mixed.scene, 1024);
  EXPECT_NEAR(passed(renderer, mixed.sun), 0.25, 3e-4);
  for (double const share : {0.0, 0.4, 1.0}) {
    renderer.set_deployments({0.5, share});
    EXPECT_NEAR(passed(renderer, mixed.sun), 1.0 - 0.75 * share, 3e-4);
  }
}

TEST_P(Screened, ShadesWhatLiesBehindAWindow) {
  Room room;
  std::vector<SurfaceId> const inside = room.surfaces;
  Renderer bare = renderer_of(room.scene, 1024);
  SunDirection const sun = sun_at(170, 40);
  std::vector<double> const before = interior_areas(bare, sun, room.window, inside);
  Scene scene = room.scene;
  HolePattern const holes = square_holes(20 * mm, 40 * mm);
  scene.add(screened("screen", south_facing(-5, -1, -5, 15, 15), sheet_of(holes, 0.0)));
  Renderer renderer = renderer_of(scene, 1024);
  std::vector<double> const after = interior_areas(renderer, sun, room.window, inside);
  double const sum = std::accumulate(before.begin(), before.end(), 0.0);
  ASSERT_GT(sum, 0.1);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i], before[i] / 4, 0.01 * sum) << i;
  }
}

// Pictures are always drawn.
TEST_P(Screened, ShowsItsHolesInThePicture) {
  Scene scene;
  scene.add({"receiver", level(0, 0, 0, 1, 1)});
  HolePattern const holes = square_holes(0.25, 0.5);
  scene.add(screened("screen", level(0, 0, 0.3, 1, 1), sheet_of(holes, 1 * mm), {0.25, 0.25, 0}));
  Renderer renderer = renderer_of(scene);
  // The sun in the zenith has north up; around the receiver is a border of 0.15 m.
  Image const image = renderer.sun_view(sun_at(0, 90), 0, 650);
  auto const is = [&](double x, double y, double fraction) {
    auto const column = static_cast<std::size_t>((x + 0.15) / 1.3 * image.width);
    auto const row = static_cast<std::size_t>((1.15 - y) / 1.3 * image.height);
    auto const at = 3 * (row * static_cast<std::size_t>(image.width) + column);
    glm::dvec3 const drawn(image.pixels.at(at), image.pixels.at(at + 1), image.pixels.at(at + 2));
    return drawn == fraction_colour(fraction);
  };
  for (double const x : {0.25, 0.75}) {
    for (double const y : {0.25, 0.75}) EXPECT_TRUE(is(x, y, 1.0)) << x << " " << y;
  }
  for (double const place : {0.05, 0.5, 0.95}) EXPECT_TRUE(is(place, 0.5, 0.0)) << place;
}

}  // namespace
}  // namespace gpu_shading
