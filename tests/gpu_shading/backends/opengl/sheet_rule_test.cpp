// The rule for perforated sheets as each back end computes it: receivers so small that all of their
// rays are one.

#include <gtest/gtest.h>

#include "each_backend.h"
#include "support/sheet_cases.h"

namespace gpu_shading {
namespace {

class SheetRule : public EachBackend {};
INSTANTIATE_TEST_SUITE_P(Is, SheetRule, backends, name_of);

void expect_for_tiny_receivers(SheetForm form, DeviceChoice device) {
  constexpr double below = 0.05;
  constexpr double size = 2e-4;
  for (SheetCase const& one : sheet_cases()) {
    glm::dvec3 const towards_sun = towards_sun_of(one);
    glm::dvec3 const in_sheet(-one.place.y, one.place.x, 0.0);
    glm::dvec3 const middle = in_sheet - towards_sun * (below / towards_sun.z);
    Scene scene;
    scene.add({"receiver", level(middle.x - size / 2, middle.y - size / 2, -below, size, size)});
    scene.add(sheet_of(one, form));
    Renderer renderer = renderer_of(std::move(scene), 64, device);
    double const lit = sunlit(renderer, to_direction(towards_sun), 0).projected_area;
    EXPECT_NEAR(lit / (size * size * towards_sun.z), one.passed, 1e-5) << one.name;
  }
}

TEST_P(SheetRule, HoldsForPatterns) { expect_for_tiny_receivers(SheetForm::pattern, GetParam()); }
TEST_P(SheetRule, HoldsForImages) { expect_for_tiny_receivers(SheetForm::image, GetParam()); }

}  // namespace
}  // namespace gpu_shading
