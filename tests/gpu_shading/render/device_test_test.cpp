// The closed forms by which `gpu_shading devices --test` judges, against exact polygon clipping,
// and by the CPU.

#include "gpu_shading/device_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "render/device_test/cases.h"
#include "support/exact.h"

namespace gpu_shading {
namespace {

TEST(DeviceTest, HasClosedFormsThatPolygonClippingConfirms) {
  int confirmed = 0;
  for (ClosedForm const& form : closed_forms()) {
    // Holes of screens are not polygons, nor are crowns.
    if (form.kind.find("screens") != std::string::npos || form.kind == "tree crowns") continue;
    for (ClosedForm::View const& view : form.views) {
      EXPECT_NEAR(view.whole, exact::projected_area(form.scene, view.sun, view.receiver), 1e-6);
      std::vector<double> exact{
          exact::projected_sunlit_area(form.scene, view.sun, view.receiver, form.factors)};
      if (!view.inside.empty()) {
        exact =
            exact::interior_areas(form.scene, view.sun, view.receiver, view.inside, form.factors);
      }
      ASSERT_EQ(view.exact.size(), exact.size());
      for (std::size_t i = 0; i < exact.size(); ++i) {
        EXPECT_NEAR(view.exact[i], exact[i], 1e-5 * view.whole) << form.kind << " " << i;
      }
      ++confirmed;
    }
  }
  EXPECT_GT(confirmed, 400);
}

TEST(DeviceTest, FindsTheCpuRight) {
  DeviceTest const test = test_device(cpu_device());
  EXPECT_EQ(test.failure, "");
  EXPECT_EQ(test.kinds.size(), closed_forms().size());
  for (DeviceTest::Kind const& kind : test.kinds) {
    EXPECT_LT(kind.error, DeviceTest::tolerance) << kind.name;
    EXPECT_GT(kind.error, 0.0) << kind.name;
    EXPECT_GT(kind.milliseconds, 0.0) << kind.name;
  }
  EXPECT_TRUE(test.right());
}

TEST(DeviceTest, JudgesByTheLargestError) {
  DeviceTest test{cpu_device(), {{"opaque casters", 1e-3, 0.5}, {"screens", 2e-3, 1.5}}, {}};
  EXPECT_TRUE(test.right());
  EXPECT_EQ(test.milliseconds(), 2.0);
  test.kinds[1].error = 5e-3;
  EXPECT_FALSE(test.right());
  test.kinds[1].error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(test.right());
  test.kinds[1].error = 0.0;
  test.failure = "no device";
  EXPECT_FALSE(test.right());
}

TEST(DeviceTest, TellsWhyADeviceCannotBeTested) {
  DeviceInfo missing;
  missing.id = numbered_device(77);
  DeviceTest const test = test_device(missing);
  EXPECT_FALSE(test.right());
  EXPECT_NE(test.failure, "");
}

}  // namespace
}  // namespace gpu_shading
