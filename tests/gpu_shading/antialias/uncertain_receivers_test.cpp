#include "gpu_shading/uncertain_receivers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "gpu_shading/perforated_screen.h"
#include "support/exact.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double span = 3.0;  // of slats, across them, m

// A window of 2 m x 2 m.
Scene with_window() {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 2, 2)});
  return scene;
}

// Level slats, so many metres in front of the window and to the right of it.
void add_slats(Scene& scene, int count, double in_front, double to_the_right = 0.0) {
  double const pitch = span / count;
  for (int i = 0; i < count; ++i) {
    scene.add({"slat", south_facing(to_the_right, -in_front, i * pitch - 0.5, 2, 0.5 * pitch)});
  }
}

std::vector<SurfaceId> behind_layers(Scene const& scene) {
  std::array<SurfaceId, 1> const window{0};
  auto const found = find_uncertain_receivers(scene, window);
  EXPECT_THAT(found.narrow, IsEmpty());
  return found.behind_layers;
}

TEST(UncertainReceivers, AreBehindParallelLayersAtOtherDistances) {
  Scene scene = with_window();
  add_slats(scene, 305, 0.10);
  EXPECT_THAT(behind_layers(scene), IsEmpty());
  add_slats(scene, 219, 0.21);
  EXPECT_THAT(behind_layers(scene), ElementsAre(0U));
  EXPECT_THROW(find_uncertain_receivers(scene, std::array<SurfaceId, 1>{9999}), std::out_of_range);
}

TEST(UncertainReceivers, AreNotBehindLayersThatDoNotBeat) {
  Scene alike = with_window();
  add_slats(alike, 100, 0.10);
  add_slats(alike, 100, 0.21);
  EXPECT_THAT(behind_layers(alike), IsEmpty());

  Scene crossed = with_window();
  add_slats(crossed, 100, 0.10);
  for (int i = 0; i < 80; ++i) {
    crossed.add({"fin", south_facing(0.025 * i, -0.2, 0, 0.0125, 2)});
  }
  EXPECT_THAT(behind_layers(crossed), IsEmpty());

  Scene side_by_side = with_window();
  add_slats(side_by_side, 100, 0.10);
  add_slats(side_by_side, 80, 0.10, 3.0);
  EXPECT_THAT(behind_layers(side_by_side), IsEmpty());

  Scene one_behind = with_window();
  add_slats(one_behind, 100, 0.10);
  add_slats(one_behind, 80, -0.10);
  EXPECT_THAT(behind_layers(one_behind), IsEmpty());

  Scene few = with_window();
  add_slats(few, 100, 0.10);
  add_slats(few, 5, 0.21);
  EXPECT_THAT(behind_layers(few), IsEmpty());
}

// A frame around most of a wall, behind a perforated sheet.
TEST(UncertainReceivers, AreNarrowOnesBehindSheets) {
  Scene scene;
  Polygon frame = south_facing(0, 0, 0, 4, 3);
  frame.holes.push_back(south_facing(0.1, 0, 0.1, 3.8, 2.8).outline);
  scene.add({"frame", frame});
  scene.add({"wall", south_facing(5, 0, 0, 4, 3)});
  std::array<SurfaceId, 2> const both{0, 1};
  scene.add({"board", south_facing(-1, -0.5, 0, 11, 3)});
  EXPECT_THAT(find_uncertain_receivers(scene, both).narrow, IsEmpty());
  Surface sheet{"sheet", south_facing(-1, -0.4, 0, 11, 3)};
  Perforation const holes{.size = 0.005, .pitch = 0.01};
  sheet.filter.set(
      PerforatedSheet{std::make_shared<PerforatedScreen const>(HolePattern(holes), Sheet{})});
  scene.add(std::move(sheet));
  EXPECT_THAT(find_uncertain_receivers(scene, both).narrow, ElementsAre(0U));
}

// On the CPU, the error of such a view is measured.
TEST(UncertainReceivers, BehindLayersMeetTheirTargetOnTheCpu) {
  constexpr double target = 1e-2;
  Scene scene = with_window();
  add_slats(scene, 305, 0.10);
  add_slats(scene, 219, 0.21);
  RendererOptions options;
  options.device = on_cpu;
  options.error = target;
  Renderer renderer(scene, options);
  double worst = 0.0;
  for (double const altitude : {5.0, 15.0, 30.0, 45.0}) {
    auto const sun = sun_at(180, altitude);
    double const exact = exact::projected_sunlit_area(scene, sun, 0);
    double const error = std::abs(sunlit(renderer, sun, 0).projected_area - exact);
    worst = std::max(worst, error / exact::projected_area(scene, sun, 0));
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, target);
}

}  // namespace
}  // namespace gpu_shading
