// The rule for perforated sheets as the CPU computes it, by single rays.

#include <gtest/gtest.h>

#include "filters/perforation/screens.h"
#include "filters/perforation/sheet_in_beam.h"
#include "filters/perforation/sheet_rays.h"
#include "support/sheet_cases.h"

namespace gpu_shading {
namespace {

SheetInBeam in_beam(SheetCase const& one, Surface const& surface) {
  Scene scene;
  scene.add(surface);
  ScreensAtDirection wanted{towards_sun_of(one), {}, {}};
  constexpr double many = 1e9;  // rays, for which images have cells
  wanted.add(0, false, many);
  return sheets_in_beam(Screens(scene), wanted, {}).front();
}

class SheetRule : public testing::TestWithParam<SheetForm> {};
INSTANTIATE_TEST_SUITE_P(Of, SheetRule, testing::Values(SheetForm::pattern, SheetForm::image));

TEST_P(SheetRule, HoldsForSingleRays) {
  for (SheetCase const& one : sheet_cases()) {
    Surface const surface = sheet_of(one, GetParam());
    SheetInBeam const sheet = in_beam(one, surface);
    EXPECT_NEAR(sheet.ray_offset.x, one.way.x, 1e-6) << one.name;
    EXPECT_NEAR(sheet.ray_offset.y, one.way.y, 1e-6) << one.name;
    SheetRays const rays(*surface.filter.find<PerforatedSheet>()->screen, sheet, 1e-4, false);
    EXPECT_FALSE(rays.everywhere().has_value()) << one.name;
    EXPECT_EQ(rays.part_of_path(one.place, 0.0, 1.0), static_cast<float>(one.passed)) << one.name;
  }
}

// Each ray in another tile.
TEST_P(SheetRule, HoldsForManyRaysAtOnce) {
  for (SheetCase const& one : sheet_cases()) {
    Surface const surface = sheet_of(one, GetParam());
    SheetInBeam const sheet = in_beam(one, surface);
    SheetRays const rays(*surface.filter.find<PerforatedSheet>()->screen, sheet, 1e-4, false);
    HolePattern const holes(one.holes);
    SheetRays::Passed passed{};
    rays.whole_paths(one.place, {holes.width(), -holes.height()}, ~std::uint64_t{0}, passed);
    for (float const ray : passed) EXPECT_EQ(ray, static_cast<float>(one.passed)) << one.name;
  }
}

}  // namespace
}  // namespace gpu_shading
