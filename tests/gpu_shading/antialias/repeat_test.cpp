#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "antialias/antialias.h"
#include "support/crowds.h"
#include "support/random_scene.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

TEST(Repeats, OfLouvresAreTheirDistance) {
  Scene scene;
  glm::dvec3 const step(0.1, 0.0, 0.37);
  for (int i = 0; i < 5; ++i) {
    scene.add({"louvre", parallelogram(double(i) * step, {7, 0, 0}, {0, -0.2, 0.1})});
  }
  EXPECT_FALSE(repeat_of(scene, 0));
  for (SurfaceId id = 1; id < scene.size(); ++id) {
    auto const repeat = repeat_of(scene, id);
    ASSERT_TRUE(repeat);
    EXPECT_LT(glm::distance(repeat->step, step), 1e-9);
    EXPECT_NEAR(glm::length(repeat->edge), 7.0, 1e-9);
  }
}

// Rounded to a two-hundredth of their distance, as in files.
TEST(Repeats, OfRoundedPiecesAreTheirMeanDistance) {
  Scene const scene = pieces_of_louvres(32000);
  auto const repeat = repeat_of(scene, 1600);
  ASSERT_TRUE(repeat);
  EXPECT_LT(glm::distance(repeat->step, {3.0 / 1600, 0.0, 0.0}), 2e-8);
  EXPECT_LT(glm::distance(glm::abs(repeat->side), {0.95 * 3.0 / 1600, 0.0, 0.0}), 1e-5);
}

// The upper side of a box is not a repeat of its lower side, which faces the other way.
TEST(Repeats, OfBoxesAreFromSideToSide) {
  Scene scene;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 const at(0.0, 0.0, 0.2 * i);
    scene.add({"lower", parallelogram(at, {0, -0.1, 0}, {3, 0, 0})});
    scene.add({"upper", parallelogram(at + glm::dvec3(0, 0, 0.02), {3, 0, 0}, {0, -0.1, 0})});
    scene.add({"front", parallelogram(at + glm::dvec3(0, -0.1, 0), {3, 0, 0}, {0, 0, 0.02})});
  }
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const repeat = repeat_of(scene, id);
    ASSERT_EQ(repeat.has_value(), id >= 3) << id;
    if (!repeat) continue;
    EXPECT_LT(glm::distance(repeat->step, {0.0, 0.0, 0.2}), 1e-9);
  }
}

TEST(Repeats, AreNoneAtRandom) {
  Scene const scene = triangle_soup(200, 1);
  for (SurfaceId id = 0; id < scene.size(); ++id) EXPECT_FALSE(repeat_of(scene, id));
}

}  // namespace
}  // namespace gpu_shading
