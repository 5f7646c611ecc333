// Divisions of the sky: their published numbers, and integrals over the hemisphere.

#include "tasks/samples/sky_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;

double whole(SkyDivision const& sky) {
  double sum = 0.0;
  for (auto const& patch : sky.patches) sum += patch.solid_angle;
  return sum;
}

// Of a horizontal plane to the sky.
double view_factor(SkyDivision const& sky) {
  double sum = 0.0;
  for (auto const& patch : sky.patches) {
    sum += patch.solid_angle * std::sin(patch.centre.altitude) / pi;
  }
  return sum;
}

void expect_centre(SkyPatch const& patch, double azimuth, double altitude) {
  EXPECT_NEAR(glm::degrees(patch.centre.azimuth), azimuth, 1e-9);
  EXPECT_NEAR(glm::degrees(patch.centre.altitude), altitude, 1e-9);
}

TEST(SkyPatches, CoverTheHemisphere) {
  for (auto const& sky : {energyplus_sky(), reinhart_sky(1), reinhart_sky(2), reinhart_sky(4)}) {
    EXPECT_NEAR(whole(sky), 2.0 * pi, 1e-12) << sky.name;
    EXPECT_NEAR(view_factor(sky), 1.0, 0.009) << sky.name;
  }
}

TEST(SkyPatches, EnergyPlusHasSixRowsOf24) {
  auto const sky = energyplus_sky();
  ASSERT_EQ(sky.patches.size(), 144U);
  expect_centre(sky.patches[0], 90.0, 7.5);
  expect_centre(sky.patches[1], 75.0, 7.5);
  expect_centre(sky.patches[143], 105.0, 82.5);
}

// Tregenza's rows are 12 degrees high, and the zenith has a diameter of 12 degrees.
TEST(SkyPatches, TregenzaHas145) {
  auto const sky = reinhart_sky(1);
  EXPECT_EQ(sky.name, "Tregenza 145");
  ASSERT_EQ(sky.patches.size(), 145U);
  expect_centre(sky.patches[0], 0.0, 6.0);
  expect_centre(sky.patches[1], 12.0, 6.0);
  expect_centre(sky.patches[30], 0.0, 18.0);
  expect_centre(sky.patches[143], 300.0, 78.0);
  expect_centre(sky.patches[144], 0.0, 90.0);
  EXPECT_NEAR(sky.patches[144].solid_angle, 2.0 * pi * (1.0 - std::cos(glm::radians(6.0))), 1e-12);
}

// What Radiance's reinsrc.cal has for MF 2 (rcalc of pyradiance 1.3.1).
TEST(SkyPatches, Reinhart577IsRadiances) {
  auto const sky = reinhart_sky(2);
  EXPECT_EQ(sky.name, "Reinhart 577");
  ASSERT_EQ(sky.patches.size(), 577U);
  EXPECT_NEAR(glm::degrees(sky.patches[299].centre.azimuth), 82.5, 1e-3);
  EXPECT_NEAR(glm::degrees(sky.patches[299].centre.altitude), 34.137931, 1e-3);
  EXPECT_NEAR(sky.patches[299].solid_angle, 0.0117312774, 1e-7);
  EXPECT_NEAR(sky.patches[576].solid_angle, 0.00921483254, 1e-7);
}

}  // namespace
}  // namespace gpu_shading::energyplus
