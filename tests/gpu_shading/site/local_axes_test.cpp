#include "gpu_shading/local_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gpu_shading/error.h"
#include "support/degree.h"

namespace gpu_shading {
namespace {

// WGS84, NIMA TR8350.2: semi-major axis, flattening.
constexpr double a = 6378137.0;
constexpr double f = 1.0 / 298.257223563;
constexpr double e2 = f * (2.0 - f);

// Radius of a meridian's curvature at a latitude.
double meridian_radius(double latitude) {
  double const s = std::sin(latitude * degree);
  return a * (1.0 - e2) / std::pow(1.0 - e2 * s * s, 1.5);
}

TEST(LocalAxes, EastAndNorthAreThoseOfTheEquator) {
  LocalAxes const axes({0.0, 20.0, 0.0});
  // A chord of the equator's circle: along x by a sin, below by a (1 - cos).
  auto const east = axes.to_local({0.0, 20.01, 0.0});
  EXPECT_NEAR(east.x, a * std::sin(0.01 * degree), 1e-6);
  EXPECT_NEAR(east.y, 0.0, 1e-9);
  EXPECT_NEAR(east.z, -a * (1.0 - std::cos(0.01 * degree)), 1e-6);
  auto const north = axes.to_local({0.01, 20.0, 0.0});
  EXPECT_NEAR(north.x, 0.0, 1e-9);
  EXPECT_NEAR(north.y, meridian_radius(0.0) * 0.01 * degree, 1e-4);
  auto const up = axes.to_local({0.0, 20.0, 12.5});
  EXPECT_NEAR(glm::distance(up, glm::dvec3(0, 0, 12.5)), 0.0, 1e-8);
}

TEST(LocalAxes, ElevationOfTheOriginIsZero) {
  LocalAxes const axes({47.4, 8.5, 408.0});
  EXPECT_NEAR(glm::length(axes.to_local({47.4, 8.5, 408.0})), 0.0, 1e-8);
  EXPECT_NEAR(axes.to_local({47.4, 8.5, 420.0}).z, 12.0, 1e-8);
}

TEST(LocalAxes, EarthCurvesAwayBy70MetresAt30Kilometres) {
  for (double const latitude : {-60.0, 0.0, 40.0}) {
    LocalAxes const axes({latitude, -105.0, 0.0});
    double const r = meridian_radius(latitude);
    auto const far = axes.to_local({latitude + 30000.0 / r / degree, -105.0, 0.0});
    // d^2 / 2 R on the meridian's own circle of curvature: 70.5 to 71.0 m.
    EXPECT_NEAR(far.z, -30000.0 * 30000.0 / (2.0 * r), 0.01);
    EXPECT_NEAR(far.z, -70.6, 0.5);
  }
}

TEST(LocalAxes, AcrossTheAntimeridianIsNear) {
  LocalAxes const axes({-16.8, 179.9995, 0.0});
  auto const west = axes.to_local({-16.8, -179.9995, 0.0});
  auto const same = axes.to_local({-16.8, 180.0005, 0.0});
  // 0.001 degrees of a circle of latitude: radius N cos(latitude).
  double const s = std::sin(-16.8 * degree);
  double const circle = a / std::sqrt(1.0 - e2 * s * s) * std::cos(16.8 * degree);
  EXPECT_NEAR(west.x, circle * std::sin(0.001 * degree), 1e-6);
  EXPECT_NEAR(glm::distance(west, same), 0.0, 1e-8);
}

TEST(LocalAxes, AtThePoleTheLongitudeTellsWhereEastIs) {
  // 100 m from the pole on the meridian opposite to the origin's is 100 m to its north.
  double const down = 100.0 / meridian_radius(90.0) / degree;
  LocalAxes const pole({90.0, 30.0, 0.0});
  auto const ahead = pole.to_local({90.0 - down, -150.0, 0.0});
  EXPECT_NEAR(ahead.x, 0.0, 1e-6);
  EXPECT_NEAR(ahead.y, 100.0, 1e-4);
  auto const right = pole.to_local({90.0 - down, 120.0, 0.0});
  EXPECT_NEAR(right.x, 100.0, 1e-4);
  EXPECT_NEAR(right.y, 0.0, 1e-6);
  // Over the pole from 50 m before it to 50 m behind it.
  LocalAxes const near({90.0 - down / 2.0, 0.0, 0.0});
  auto const over = near.to_local({90.0 - down / 2.0, 180.0, 0.0});
  EXPECT_NEAR(over.x, 0.0, 1e-6);
  EXPECT_NEAR(over.y, 100.0, 1e-3);
}

TEST(LocalAxes, GoesBackTheWayItCame) {
  LocalAxes const axes({-33.9, 151.2, 30.0});
  glm::dvec3 const point(25000.0, -17000.0, 120.0);
  auto const place = axes.to_geographic(point);
  EXPECT_NEAR(glm::distance(axes.to_local(place), point), 0.0, 1e-6);
}

TEST(LocalAxes, AxesOfAPlaceLeanOutwards) {
  LocalAxes const axes({0.0, 0.0, 0.0});
  EXPECT_NEAR(glm::distance(axes.axes_at({0.0, 0.0, 5.0})[0], glm::dvec3(1, 0, 0)), 0.0, 1e-12);
  // On the equator turned about its north by the longitude.
  auto const leaning = axes.axes_at({0.0, 0.27, 0.0});
  double const angle = 0.27 * degree;
  EXPECT_NEAR(glm::distance(leaning[0], glm::dvec3(std::cos(angle), 0, -std::sin(angle))), 0, 1e-9);
  EXPECT_NEAR(glm::distance(leaning[1], glm::dvec3(0, 1, 0)), 0, 1e-9);
  EXPECT_NEAR(glm::distance(leaning[2], glm::dvec3(std::sin(angle), 0, std::cos(angle))), 0, 1e-9);
}

TEST(LocalAxes, RefusesWhatIsNowhere) {
  EXPECT_THROW(LocalAxes({90.1, 0.0, 0.0}), Error);
  EXPECT_THROW(LocalAxes({std::nan(""), 0.0, 0.0}), Error);
  EXPECT_THROW(LocalAxes({0.0, std::nan(""), 0.0}), Error);
  EXPECT_THROW(LocalAxes({0.0, 0.0, INFINITY}), Error);
}

}  // namespace
}  // namespace gpu_shading
