#include "geometry/triangulation.h"

#include <gtest/gtest.h>

#include <clipper.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "support/random_scene.h"

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

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint32_t seed) : generator_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  int below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(generator_); }

 private:
  std::mt19937 generator_;
};

// Area of what an odd number of rings in z = 0 encloses, by Clipper's polygon boolean.
double odd_even_area(Polygon const& polygon) {
  constexpr double scale = 1e9;
  ClipperLib::Clipper clipper;
  auto const add = [&](Ring const& ring) {
    ClipperLib::Path path;
    for (auto const& vertex : ring) {
      path.emplace_back(std::llround(vertex.x * scale), std::llround(vertex.y * scale));
    }
    clipper.AddPath(path, ClipperLib::ptSubject, true);
  };
  add(polygon.outline);
  for (Ring const& hole : polygon.holes) add(hole);
  ClipperLib::Paths paths;
  clipper.Execute(ClipperLib::ctUnion, paths, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
  double sum = 0.0;
  for (auto const& path : paths) sum += ClipperLib::Area(path) / (scale * scale);
  return sum;
}

double absolute_area(Mesh const& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    sum += 0.5 * glm::length(glm::cross(
                     mesh.vertices[mesh.indices[i + 1]] - mesh.vertices[mesh.indices[i]],
                     mesh.vertices[mesh.indices[i + 2]] - mesh.vertices[mesh.indices[i]]));
  }
  return sum;
}

TEST(Triangulation, RandomRingsThatIntersectThemselvesAndTheirHoles) {
  RandomNumbers random(1);
  for (int i = 0; i < 300; ++i) {
    Polygon polygon;
    for (int k = 3 + random.below(8); k > 0; --k) {
      polygon.outline.emplace_back(random.between(0, 10), random.between(0, 10), 0.0);
    }
    for (int holes = random.below(3); holes > 0; --holes) {
      Ring& hole = polygon.holes.emplace_back();
      for (int k = 3 + random.below(4); k > 0; --k) {
        hole.emplace_back(random.between(2, 8), random.between(2, 8), 0.0);
      }
    }
    EXPECT_NEAR(absolute_area(triangulate(polygon)), odd_even_area(polygon), 1e-6) << i;
  }
}

// As models have them: turned, in single precision, some windows side by side.
TEST(Triangulation, WallsWithManyWindowsInSinglePrecision) {
  RandomNumbers random(2);
  for (int i = 0; i < 100; ++i) {
    double const turn = random.between(0.0, 6.28);
    auto const at = [&](double x, double y) {
      return glm::dvec3(static_cast<float>(x * std::cos(turn) - y * std::sin(turn)),
                        static_cast<float>(x * std::sin(turn) + y * std::cos(turn)), 0.0);
    };
    Polygon polygon{{at(0, 0), at(10, 0), at(10, 4), at(0, 4)}, {}};
    for (int column = 0; column < 10; ++column) {
      for (int row = 0; row < 4; ++row) {
        if (random.below(2) == 0) continue;
        double const size = random.below(3) == 0 ? 1.0 : 0.7;
        polygon.holes.push_back({at(column, row), at(column + size, row),
                                 at(column + size, row + size), at(column, row + size)});
      }
    }
    EXPECT_NEAR(absolute_area(triangulate(polygon)), odd_even_area(polygon), 1e-6) << i;
  }
}

// Rings round this point.
int windings(Polygon const& polygon, glm::dvec3 const& point) {
  int crossings = 0;
  auto const count = [&](Ring const& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      glm::dvec3 const& a = ring[i];
      glm::dvec3 const& b = ring[(i + 1) % ring.size()];
      if ((a.y > point.y) == (b.y > point.y)) continue;
      if (a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x) > point.x) ++crossings;
    }
  };
  count(polygon.outline);
  for (Ring const& hole : polygon.holes) count(hole);
  return crossings;
}

int covers(Mesh const& mesh, glm::dvec3 const& point) {
  int sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    Polygon triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.outline.push_back(mesh.vertices[mesh.indices[i + k]]);
    }
    sum += windings(triangle, point) % 2;
  }
  return sum;
}

// Corners on a coarse grid: edges that coincide, spikes, rings that touch. Points are looked at one
// by one, since Clipper 6.4 gets some of these wrong.
TEST(Triangulation, DegenerateRingsAreCoveredWhereTheyWindAnOddNumberOfTimes) {
  RandomNumbers random(3);
  for (int i = 0; i < 500; ++i) {
    Polygon polygon;
    auto const corner = [&] { return glm::dvec3(random.below(6), random.below(6), 0.0); };
    for (int k = 3 + random.below(8); k > 0; --k) polygon.outline.push_back(corner());
    if (random.below(2) == 0) polygon.holes = {{corner(), corner(), corner(), corner()}};
    Mesh const mesh = triangulate(polygon);
    if (mesh.indices.empty()) continue;  // no area by Newell's method
    for (int k = 0; k < 50; ++k) {
      glm::dvec3 const point(random.between(0, 5), random.between(0, 5), 0.0);
      ASSERT_EQ(covers(mesh, point), windings(polygon, point) % 2) << i;
    }
  }
}

TEST(Triangulation, HasNoCornerInTheMiddleOfAnEdge) {
  Polygon const polygon{wall, {opening(1, 1, 2, 2), opening(4, 0.5, 1, 3), opening(6, 2, 3, 1)}};
  Mesh const mesh = triangulate(polygon);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    glm::dvec3 const& a = mesh.vertices[mesh.indices[i]];
    glm::dvec3 const& b = mesh.vertices[mesh.indices[i % 3 == 2 ? i - 2 : i + 1]];
    for (glm::dvec3 const& p : mesh.vertices) {
      if (p == a || p == b) continue;
      EXPECT_GT(glm::distance(a, p) + glm::distance(p, b), glm::distance(a, b) + 1e-12);
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
  double const sum = absolute_area(triangulate({star, {}}));
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
