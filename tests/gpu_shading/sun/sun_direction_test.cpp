#include "gpu_shading/sun_direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/degree.h"

namespace gpu_shading {
namespace {

TEST(SunDirection, NorthEastSouthWestAtTheHorizon) {
  EXPECT_LT(glm::distance(to_vector({0.0, 0.0}), glm::dvec3(0, 1, 0)), 1e-15);
  EXPECT_LT(glm::distance(to_vector({90 * degree, 0.0}), glm::dvec3(1, 0, 0)), 1e-15);
  EXPECT_LT(glm::distance(to_vector({180 * degree, 0.0}), glm::dvec3(0, -1, 0)), 1e-15);
  EXPECT_LT(glm::distance(to_vector({270 * degree, 0.0}), glm::dvec3(-1, 0, 0)), 1e-15);
}

TEST(SunDirection, ThereAndBack) {
  for (int azimuth = 0; azimuth < 360; azimuth += 7) {
    for (int altitude = -88; altitude < 90; altitude += 11) {
      SunDirection const back =
          to_direction(3.0 * to_vector({azimuth * degree, altitude * degree}));
      EXPECT_NEAR(back.azimuth, azimuth * degree, 1e-12);
      EXPECT_NEAR(back.altitude, altitude * degree, 1e-12);
    }
  }
}

TEST(SunDirection, ZenithIsTheDefaultAndHasAzimuthZero) {
  EXPECT_LT(glm::distance(to_vector({}), glm::dvec3(0, 0, 1)), 1e-15);
  SunDirection const zenith = to_direction(to_vector({1.0, 90 * degree}));
  EXPECT_EQ(zenith.azimuth, 0.0);
  EXPECT_NEAR(zenith.altitude, 90 * degree, 1e-15);
}

}  // namespace
}  // namespace gpu_shading
