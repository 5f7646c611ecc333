#include "scene/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "random_scene.h"

namespace gpu_shading {
namespace {

double triangles_area(Mesh const& mesh, glm::dvec3 const& up) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    glm::dvec3 const& a = mesh.vertices.at(mesh.indices[i]);
    glm::dvec3 const& b = mesh.vertices.at(mesh.indices[i + 1]);
    glm::dvec3 const& c = mesh.vertices.at(mesh.indices[i + 2]);
    double const twice = glm::dot(up, glm::cross(b - a, c - a));
    EXPECT_GE(twice, -1e-12) << "a triangle turned over";
    sum += 0.5 * twice;
  }
  return sum;
}

void expect_covered(Polygon const& polygon) {
  Mesh const mesh = triangulate(polygon);
  EXPECT_EQ(mesh.indices.size() % 3, 0U);
  double const exact = area(polygon);
  EXPECT_NEAR(triangles_area(mesh, normal(polygon)), exact, 1e-9 * exact);
}

Ring const wall{{0, 0, 0}, {10, 0, 0}, {10, 0, 4}, {0, 0, 4}};

Ring opening(double x, double z, double width, double height) {
  return {{x, 0, z}, {x + width, 0, z}, {x + width, 0, z + height}, {x, 0, z + height}};
}

TEST(Triangulation, ConvexIsAFanOfTwoLessTrianglesThanVertices) {
  EXPECT_EQ(triangulate({wall, {}}).indices.size(), 6U);
  expect_covered({wall, {}});
}

TEST(Triangulation, NonConvexKeepsItsNotch) {
  expect_covered({{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, {}});
}

TEST(Triangulation, WallWithWindowsRunningEitherWay) {
  Ring const one = opening(1, 1, 2, 2);
  Ring const other = opening(5, 1, 3, 1.5);
  expect_covered({wall, {one, other}});
  expect_covered({wall, {{one.rbegin(), one.rend()}, other}});
}

TEST(Triangulation, WindowsThatTouchTheEdgeAndEachOther) {
  expect_covered({wall, {opening(0, 1, 2, 2), opening(2, 1, 3, 2)}});
}

TEST(Triangulation, RandomPolygonsAreCoveredOnce) {
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    RandomScene const random = random_scene(seed);
    for (SurfaceId id = 0; id < random.scene.size(); ++id) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", surface " << id);
      expect_covered(random.scene[id].polygon);
    }
  }
}

TEST(Triangulation, AtSiteCoordinates) {
  Polygon polygon{wall, {opening(1, 1, 2, 2)}};
  for (Ring* ring : {&polygon.outline, &polygon.holes[0]}) {
    for (auto& vertex : *ring) vertex += glm::dvec3(5e5, -5e5, 1e3);
  }
  Mesh const mesh = triangulate(polygon);
  EXPECT_NEAR(triangles_area(mesh, normal(polygon)), 36.0, 1e-7);
}

TEST(Triangulation, APentagramIsNotTakenForConvex) {
  // Turns left everywhere, but twice round: odd winding leaves its middle out.
  Ring star;
  for (int i : {0, 2, 4, 1, 3}) {
    double const turn = 2.0 * 3.14159265358979323846 * i / 5.0;
    star.push_back({std::cos(turn), std::sin(turn), 0.0});
  }
  double sum = 0.0;
  Mesh const mesh = triangulate({star, {}});
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    sum += 0.5 * glm::length(glm::cross(
                     mesh.vertices[mesh.indices[i + 1]] - mesh.vertices[mesh.indices[i]],
                     mesh.vertices[mesh.indices[i + 2]] - mesh.vertices[mesh.indices[i]]));
  }
  // Five points of the unit pentagram: its outline 1.12257 less the inner pentagon 0.34690.
  EXPECT_NEAR(sum, 1.12257 - 0.34690, 1e-4);
}

TEST(Triangulation, DegeneratePolygonsAreDropped) {
  EXPECT_TRUE(triangulate({}).indices.empty());
  EXPECT_TRUE(triangulate({{{0, 0, 0}, {1, 0, 0}}, {}}).indices.empty());
  EXPECT_TRUE(triangulate({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {}}).indices.empty());
  EXPECT_TRUE(triangulate({{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {}}).indices.empty());
}

TEST(Triangulation, RepeatedVerticesDoNoHarm) {
  Polygon const doubled{{{0, 0, 0}, {0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {3, 2, 0}, {0, 2, 0}}, {}};
  EXPECT_EQ(triangulate(doubled).indices.size(), 6U);
  expect_covered(doubled);
}

}  // namespace
}  // namespace gpu_shading
