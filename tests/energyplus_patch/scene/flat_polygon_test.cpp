#include "scene/flat_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace gpu_shading::energyplus {
namespace {

glm::dvec3 mean(std::vector<glm::dvec3> const& points) {
  glm::dvec3 sum{0.0};
  for (auto const& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

// An L with arms of 3 m x 1 m and 1 m x 1 m, tilted by 3 in 4: its centre is known in closed form.
TEST(PolygonSamples, LieInsideAndAroundTheCentre) {
  glm::dvec3 const along{1, 0, 0};
  glm::dvec3 const up{0, 0.8, 0.6};
  auto const at = [&](double x, double y) { return glm::dvec3(5, 6, 7) + x * along + y * up; };
  Polygon const polygon{{at(0, 0), at(3, 0), at(3, 1), at(1, 1), at(1, 2), at(0, 2)}, {}};
  auto const points = polygon_samples(polygon, 400);
  ASSERT_EQ(points.size(), 400U);
  for (auto const& point : points) {
    double const x = glm::dot(point - at(0, 0), along);
    double const y = glm::dot(point - at(0, 0), up);
    EXPECT_TRUE(x >= 0 && y >= 0 && (y <= 1 ? x <= 3 : x <= 1 && y <= 2)) << x << ' ' << y;
    EXPECT_NEAR(glm::dot(point - at(0, 0), normal(polygon)), 0.0, 1e-12);
  }
  EXPECT_LT(glm::distance(mean(points), at(5.0 / 4.0, 3.0 / 4.0)), 0.02);
}

TEST(PolygonSamples, PassHolesOver) {
  Ring const hole{{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}};
  auto const points = polygon_samples({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {hole}}, 100);
  ASSERT_EQ(points.size(), 100U);
  for (auto const& point : points) {
    EXPECT_TRUE(std::abs(point.x - 2) >= 1 || std::abs(point.y - 2) >= 1);
  }
}

TEST(PolygonSamples, NoneOfWhatHasNoArea) {
  EXPECT_TRUE(polygon_samples({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}}, 10).empty());
  EXPECT_TRUE(polygon_samples({}, 10).empty());
}

}  // namespace
}  // namespace gpu_shading::energyplus
