#include "hidden/hidden_luminance.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;

constexpr double reflectance = 0.6;
constexpr double wide = 1e4;

// A model with one surface that EnergyPlus does not know.
Model model_with(Ring outline) {
  Model model;
  model.shading.shading_surfaces["WALL"] = {
      .type = "Shading:Building:Detailed", .reflectance = 0.1, .visible_reflectance = reflectance};
  Surface wall;
  wall.name = "WALL";
  wall.polygon.outline = std::move(outline);
  model.lean.casters.push_back(std::move(wall));
  return model;
}

// Upright, 5 m to the north.
Ring const upright{{10, 5, 0}, {-10, 5, 0}, {-10, 5, 9}, {10, 5, 9}};

void make_transparent(Model& model, double transmittance) {
  auto& shade = model.shades.by_surface["WALL"];
  auto const constant = [](double value) -> FilterFactor {
    return AngularTransmittance{
        std::make_shared<Transmittance const>(Transmittance::constant(value))};
  };
  shade.solar = constant(0.05);
  shade.visible = constant(transmittance);
}

struct Hidden {
  explicit Hidden(Model model) : scene(std::move(model)) {
    scene.complete({});
    luminance.emplace(scene);
  }

  SceneAssembly scene;
  std::optional<HiddenLuminance> luminance;
};

Ray const to_north{{0, 0, 1}, {0, 1, 0}};
glm::dvec3 const southern_sun{0.0, -0.6, 0.8};

TEST(HiddenLuminance, OpaqueWallReflectsSunAndSky) {
  Hidden hidden(model_with(upright));
  ASSERT_TRUE(hidden.luminance->any());
  EXPECT_TRUE(hidden.luminance->meets(to_north));
  auto const view = hidden.luminance->view(to_north, 12, southern_sun);
  EXPECT_EQ(view.passed, 0.0);
  EXPECT_NEAR(view.sun, reflectance * 0.6 / pi, 1e-12);
  EXPECT_NEAR(view.sky, reflectance * 0.5 / pi, 1e-12);
}

TEST(HiddenLuminance, OnlyTheSideThatIsSeenCounts) {
  Hidden hidden(model_with(upright));
  Ray const from_behind{{0, 9, 1}, {0, -1, 0}};
  EXPECT_EQ(hidden.luminance->view(from_behind, 12, southern_sun).sun, 0.0);
}

TEST(HiddenLuminance, WallBeyondTheRaysEndIsNotSeen) {
  Hidden hidden(model_with(upright));
  Ray const segment{{0, 0, 1}, {0, 1, 0}, 4.0};
  EXPECT_FALSE(hidden.luminance->meets(segment));
  auto const view = hidden.luminance->view(segment, 12, southern_sun);
  EXPECT_EQ(view.passed, 1.0);
  EXPECT_EQ(view.sun, 0.0);
  EXPECT_EQ(view.sky, 0.0);
}

TEST(HiddenLuminance, TransparentWallReflectsNoMoreThanItStops) {
  constexpr double transmittance = 0.7;
  auto model = model_with(upright);
  make_transparent(model, transmittance);
  Hidden hidden(std::move(model));
  auto const view = hidden.luminance->view(to_north, 12, southern_sun);
  EXPECT_DOUBLE_EQ(view.passed, transmittance);
  EXPECT_NEAR(view.sun, (1.0 - transmittance) * 0.6 / pi, 1e-12);
  EXPECT_NEAR(view.sky, (1.0 - transmittance) * 0.5 / pi, 1e-12);
  EXPECT_DOUBLE_EQ(hidden.luminance->transmittance(to_north, 12), transmittance);
}

TEST(HiddenLuminance, GroundSeesTheSkyThatIsLeft) {
  // Over the northern half.
  Hidden hidden(model_with({{-wide, 0, 1}, {wide, 0, 1}, {wide, wide, 1}, {-wide, wide, 1}}));
  auto const half = hidden.luminance->sky_on_ground({0, 0, 0});
  ASSERT_TRUE(half.has_value());
  EXPECT_NEAR(*half, 0.5, 1e-12);
  EXPECT_FALSE(hidden.luminance->sky_on_ground({0, 0, 2}).has_value());
}

TEST(HiddenLuminance, WithoutCastersThereIsNothingToAsk) {
  Hidden hidden(Model{});
  EXPECT_FALSE(hidden.luminance->any());
}

}  // namespace
}  // namespace gpu_shading::energyplus
