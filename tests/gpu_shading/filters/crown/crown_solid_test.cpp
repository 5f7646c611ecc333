// The path of a ray through a crown's solid, against its definition point by point, the projection
// of leaves, against leaves drawn at random, and the pixels of a tile, against rays.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <random>

#include "filters/crown/crowns.h"
#include "geometry/plane_frame.h"
#include "gpu_shading/error.h"
#include "gpu_shading/rays.h"
#include "support/crown_meshes.h"
#include "support/shapes.h"
#include "view/tile.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

constexpr std::array shapes{CrownShape::ellipsoid, CrownShape::cone, CrownShape::cylinder,
                            CrownShape::half_ellipsoid};

// In the cube from -1 to 1.
bool is_inside(CrownShape shape, glm::dvec3 const& p) {
  if (std::abs(p.z) > 1.0) return false;
  double const radius = std::hypot(p.x, p.y);
  double const up = 0.5 * (p.z + 1.0);  // 0 at the base, 1 at the top
  switch (shape) {
    case CrownShape::ellipsoid:
      return glm::dot(p, p) <= 1.0;
    case CrownShape::cone:
      return radius <= 1.0 - up;
    case CrownShape::cylinder:
      return radius <= 1.0;
    case CrownShape::half_ellipsoid:
      return radius * radius + up * up <= 1.0;
    case CrownShape::mesh:
      break;
  }
  return false;
}

double stepped_length(CrownShape shape, glm::dvec3 const& from, glm::dvec3 const& step) {
  constexpr int steps = 40000;
  constexpr double reach = 8.0;
  int inside = 0;
  for (int i = 0; i < steps; ++i) {
    double const t = reach * (2.0 * (i + 0.5) / steps - 1.0);
    if (is_inside(shape, from + t * step)) ++inside;
  }
  return 2.0 * reach * inside / steps;
}

TEST(CrownSolid, PathsAreThoseOfItsPoints) {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-0.9, 0.9);
  for (CrownShape const shape : shapes) {
    double seen = 0.0;
    for (int i = 0; i < 200; ++i) {
      glm::dvec3 const from(uniform(engine), uniform(engine), uniform(engine));
      glm::dvec3 step = glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine)));
      if (i % 10 == 0) step = {0.0, 0.0, i % 20 == 0 ? 1.0 : -1.0};
      if (i % 10 == 1) step = {0.6, 0.8, 0.0};
      if (i % 10 == 2) step = glm::normalize(glm::dvec3(1e-4 * i, 0.0, -1.0));
      double const found = solid_of(shape).inside(from, step).length();
      EXPECT_NEAR(found, stepped_length(shape, from, step), 1.5e-3) << static_cast<int>(shape) << i;
      seen += found;
    }
    EXPECT_GT(seen, 50.0);
  }
}

// Leaves with random normals, by de Wit's shares of inclinations.
double drawn_projection(LeafAngles angles, double zenith) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr int leaves = 400000;
  double sum = 0.0;
  for (int count = 0; count < leaves;) {
    double const inclination = 0.5 * pi * uniform(engine);
    double const share = angles == LeafAngles::planophile    ? std::pow(std::cos(inclination), 2)
                         : angles == LeafAngles::erectophile ? std::pow(std::sin(inclination), 2)
                                                             : std::sin(inclination);
    if (uniform(engine) > share) continue;
    double const azimuth = 2.0 * pi * uniform(engine);
    sum += std::abs(std::cos(zenith) * std::cos(inclination) +
                    std::sin(zenith) * std::sin(inclination) * std::cos(azimuth));
    ++count;
  }
  return sum / leaves;
}

TEST(LeafProjection, IsTheMeanOverLeaves) {
  for (LeafAngles const angles :
       {LeafAngles::spherical, LeafAngles::planophile, LeafAngles::erectophile}) {
    double hemisphere = 0.0;
    constexpr int rings = 2000;
    for (int i = 0; i < rings; ++i) {
      double const zenith = (i + 0.5) * 0.5 * pi / rings;
      hemisphere += leaf_projection(angles, std::cos(zenith)) * std::sin(zenith) * 0.5 * pi / rings;
      if (i % 400 == 0) {
        EXPECT_NEAR(leaf_projection(angles, std::cos(zenith)), drawn_projection(angles, zenith),
                    2e-3);
      }
    }
    // Any leaf projects half of its area on average over all directions.
    EXPECT_NEAR(hemisphere, 0.5, 1e-5);
  }
  // de Wit's leaves under a beam from the zenith: 8 / (3 pi) and 4 / (3 pi).
  EXPECT_NEAR(leaf_projection(LeafAngles::planophile, 1.0), 8.0 / (3.0 * pi), 1e-6);
  EXPECT_NEAR(leaf_projection(LeafAngles::erectophile, 1.0), 4.0 / (3.0 * pi), 1e-6);
}

Surface crown_of(double diameter, Crown const& crown) {
  Surface surface{"crown", level(-diameter / 2, -diameter / 2, 2.0, diameter, diameter)};
  surface.filter.set(crown);
  return surface;
}

TEST(CrownRays, PassTheirPartOfTheCrown) {
  Scene scene;
  scene.add(crown_of(4.0, {.height = 4.0, .leaf_density = 0.8, .deployment = 0}));
  RayScene const rays(scene, {});
  double const all = std::exp(-0.5 * 0.8 * 4.0);
  double const infinite = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(rays.transmittance({{0, 0, 0}, {0, 0, 1}, infinite}), all, 1e-12);
  EXPECT_NEAR(rays.transmittance({{-9, 0, 4}, {1, 0, 0}, infinite}), all, 1e-12);
  // From its centre, or only to it.
  EXPECT_NEAR(rays.transmittance({{0, 0, 4}, {0, 0.6, 0.8}, infinite}), std::sqrt(all), 1e-12);
  EXPECT_NEAR(rays.transmittance({{0, 0, 1}, {0, 0, 1}, 3.0}), std::sqrt(all), 1e-12);
  EXPECT_EQ(rays.transmittance({{0, 0, 0}, {0, 0, 1}, 2.0}), 1.0);
  EXPECT_EQ(rays.transmittance({{2.1, 0, 0}, {0, 0, 1}, infinite}), 1.0);
  // With a quarter of its leaves.
  std::vector<double> const shares{0.25};
  RayConditions conditions;
  conditions.deployments = shares;
  EXPECT_NEAR(rays.transmittance({{0, 0, 0}, {0, 0, 1}, infinite}, conditions), std::pow(all, 0.25),
              1e-12);
}

// A crown that the plane of a receiver may cut.
Scene random_crown(std::mt19937& engine, CrownShape shape) {
  auto const between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  Scene scene;
  scene.add({"receiver", level(-3, -3, 2.5, 6, 5)});
  Surface crown{"crown",
                level(between(-6, 2), between(-6, 2), between(0, 6), between(1, 6), between(1, 6))};
  static auto const ball = ball_mesh(16);
  crown.filter.set(Crown{.shape = shape,
                         .height = between(1, 6),
                         .leaf_density = between(0.1, 2),
                         .mesh = shape == CrownShape::mesh ? ball : nullptr});
  scene.add(crown);
  return scene;
}

TEST(CrownPixels, PassWhatTheirRaysDo) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::size_t dimmed = 0;
  for (int i = 0; i < 250; ++i) {
    Scene const scene = random_crown(
        engine, i < 200 ? shapes.at(static_cast<std::size_t>(i) % 4) : CrownShape::mesh);
    // Now and then along the axis, or nearly so: in parallel to a cylinder's sides.
    int const steps = i / 20;
    double const altitude = i % 20 < 4 ? 90.0 - 0.5 * steps : 10.0 + 75.0 * uniform(engine);
    glm::dvec3 const towards_sun = to_vector(sun_at(360.0 * uniform(engine), altitude));
    auto const frame = plane_frame(scene[0].polygon).value();
    constexpr int side = 70;
    TileMap const map = fit_tile(frame, scene[0].polygon.outline, side);
    View const pixels = in_pixels(view_in_front(frame, map, towards_sun), {side, side, 0.0});
    LuminanceTile shaded;
    shaded.start(side, 0, side);
    PixelMask lit;
    lit.start(side, 0, side);
    Crowns const crowns(scene);
    CrownInBeam const crown{&crowns[0], towards_sun, crowns[0].extinction(towards_sun, {})};
    shade_by_crowns(shaded, lit, pixels, {&crown, 1});
    glm::dmat3 const from_pixels = glm::inverse(glm::transpose(
        glm::dmat3(glm::dvec3(pixels.x), glm::dvec3(pixels.y), glm::dvec3(pixels.cut))));
    RayScene const rays(scene, {});
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        glm::dvec3 const on_receiver(column + 0.5 - pixels.x.w, row + 0.5 - pixels.y.w,
                                     1e-9 - pixels.cut.w);
        RayConditions conditions;
        conditions.receiver = 0;
        double const passed = rays.transmittance(
            {pixels.origin + from_pixels * on_receiver, towards_sun}, conditions);
        float const found = shaded.row(row)[static_cast<std::size_t>(column)];
        ASSERT_NEAR(found, passed, 2.5e-5) << i << ' ' << row << ' ' << column;
        if (passed < 0.99) ++dimmed;
      }
    }
  }
  EXPECT_GT(dimmed, 100000U);
}

// Two boxes, one through the side of which the ray passes, and a face that is turned.
TEST(CrownMeshes, PathsThroughBoxesAreInClosedForm) {
  auto triangles = box_triangles({-1.0, -1.0, -1.0}, {1.0, 1.0, -0.5});
  for (auto const& triangle : box_triangles({-0.5, -0.25, 0.5}, {1.0, 0.75, 1.0})) {
    triangles.push_back(triangle);
  }
  std::swap(triangles[3][0], triangles[3][1]);
  auto const mesh = std::make_shared<CrownMesh const>(triangles);
  EXPECT_NEAR(mesh->volume(), 2.0 + 0.75, 1e-12);
  Scene scene;
  scene.add(crown_of(4.0, {.shape = CrownShape::mesh, .height = 8.0, .mesh = mesh}));
  RayScene const rays(scene, {});
  // The slab is from z 2 to 4, and the box from x -1 to 2, y -0.5 to 1.5 and z 8 to 10.
  auto const path = [&](glm::dvec3 const& from, glm::dvec3 const& towards, double length) {
    return -2.0 * std::log(rays.transmittance({from, towards, length}));
  };
  EXPECT_NEAR(path({0, 0, 0}, {0, 0, 1}, HUGE_VAL), 4.0, 1e-12);
  EXPECT_NEAR(path({-1.5, 0, 20}, {0, 0, -1}, HUGE_VAL), 2.0, 1e-12);
  EXPECT_NEAR(path({0, 0, 3}, {0, 0, 1}, 6.0), 1.0 + 1.0, 1e-12);
  EXPECT_NEAR(path({-9, 1.4, 9}, {1, 0, 0}, HUGE_VAL), 3.0, 1e-12);
  EXPECT_NEAR(path({-9, 1.6, 9}, {1, 0, 0}, HUGE_VAL), 0.0, 1e-12);
  EXPECT_NEAR(path({-2, 0, 1}, {0.6, 0, 0.8}, HUGE_VAL), 2.0 / 0.8, 1e-12);
  // Along the diagonal of faces, where two of their triangles meet, and through corners.
  EXPECT_NEAR(path({0, 0, 20}, glm::normalize(glm::dvec3(-1e-9, 1e-9, -1)), HUGE_VAL), 4.0, 1e-6);
  EXPECT_NEAR(path({-4, -4, 0}, glm::normalize(glm::dvec3(1, 1, 1)), HUGE_VAL), std::sqrt(12.0),
              1e-9);
}

TEST(CrownMeshes, OpenOnesAreErrors) {
  auto triangles = box_triangles(glm::dvec3(-1.0), glm::dvec3(1.0));
  triangles.pop_back();
  try {
    CrownMesh const open(triangles);
    FAIL();
  } catch (Error const& error) {
    EXPECT_STREQ(error.what(),
                 "the edge from (-1, -1, 1) to (-1, 1, 1) of a crown's mesh belongs to 1 triangle, "
                 "expected 2 in a closed mesh");
  }
  EXPECT_THROW(CrownMesh(box_triangles(glm::dvec3(-1.0), glm::dvec3(1.1))), Error);
}

TEST(Crowns, MistakesAreNamed) {
  auto const message = [](Surface const& surface) {
    Scene scene;
    scene.add(surface);
    try {
      Crowns const crowns(scene);
    } catch (Error const& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(crown_of(4.0, {})), "");
  EXPECT_EQ(message(crown_of(4.0, {.height = -1.0})),
            "surface 'crown': height of a crown is -1, expected 0.001 to 10000");
  EXPECT_EQ(message(crown_of(4.0, {.leaf_density = std::nan("")})),
            "surface 'crown': leaf area density of a crown is nan, expected 0 to 1000");
  Surface skewed = crown_of(4.0, {});
  skewed.polygon.outline[2].x += 0.1;
  EXPECT_EQ(message(skewed),
            "surface 'crown': a crown needs a rectangle without holes for its plan");
}

}  // namespace
}  // namespace gpu_shading
