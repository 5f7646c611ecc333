#include "calculation/reflected_irradiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/idf/model_file.h"

namespace gpu_shading::energyplus {
namespace {

constexpr double latitude = 40.0 * std::numbers::pi / 180.0;
constexpr double far = 2000.0;  // m, half of what stands for a surface without end
SkyWeather const high_sun{{0.0, -0.5, std::sqrt(0.75)}, 800.0, 100.0, 80};
// Of the sky, the wall takes half from the ground before it.
SkyWeather const beam_alone{high_sun.towards_sun, 800.0, 0.0, 80};

Surface surface_of(std::string name, Ring outline) {
  Surface surface;
  surface.name = std::move(name);
  surface.polygon.outline = std::move(outline);
  return surface;
}

// A wall of 2 x 2 m that faces south, on the ground, and what stands before it.
class Wall {
 public:
  explicit Wall(std::string const& idf = "", std::vector<Surface> const& shades = {},
                std::map<std::string, double> const& mirrors = {})
      : assembly_(model_of(idf, mirrors)) {
    assembly_.add(surface_of("WALL", {{0, 0, 2}, {0, 0, 0}, {2, 0, 0}, {2, 0, 2}}));
    for (auto const& shade : shades) assembly_.add(shade);
    assembly_.complete({[](std::string const&) { return std::pair(0.0, 1.0); },
                        [this](std::string const&, Moment) { return schedule; }});
  }

  Reflected at(SkyWeather const& weather, double ground) {
    return irradiance().at({{12, 1}, weather, ground}, {{{}, 1.0}}).front();
  }

  double schedule = 0.0;

 private:
  ReflectedIrradiance& irradiance() {
    if (!irradiance_) irradiance_.emplace(assembly_, latitude, silent());
    return *irradiance_;
  }

  static Messages silent() {
    auto const ignore = [](std::string const&) {};
    return {ignore, ignore, ignore};
  }

  static Model model_of(std::string const& idf, std::map<std::string, double> const& mirrors) {
    Model model;
    model.shading = read_shading_input(read_idf("Wall:Exterior,WALL,,ZONE;" + idf));
    model.reflected_light.receivers = {{"WALL", "GROUND OF WALL", 0.5}};
    model.reflected_light.mirrors = mirrors;
    return model;
  }

  SceneAssembly assembly_;
  std::optional<ReflectedIrradiance> irradiance_;
};

TEST(ReflectedIrradiance, OpenGroundIsEnergyPlusS) {
  // No shadow of a wall falls before it.
  Wall wall;
  auto const light = wall.at(beam_alone, 0.2);
  EXPECT_NEAR(light.by_ground, beam_alone.open_ground() * 0.2 * 0.5, 0.005 * light.by_ground);
  EXPECT_EQ(light.by_shades, 0.0);
}

TEST(ReflectedIrradiance, GroundOfAnotherReflectanceIsWeighedAnew) {
  Wall wall;
  double const grass = wall.at(high_sun, 0.2).by_ground;
  EXPECT_NEAR(wall.at(high_sun, 0.7).by_ground, 3.5 * grass, 1e-9 * grass);
  EXPECT_EQ(wall.at(high_sun, 0.0).sum(), 0.0);
}

// At the foot of the wall, so that it hides the ground.
Surface ledge() {
  return surface_of("LEDGE",
                    {{-far, 0, 0.001}, {-far, -far, 0.001}, {far, -far, 0.001}, {far, 0, 0.001}});
}

TEST(ReflectedIrradiance, LedgeAboveBlackGroundReflectsAsItsReflectance) {
  std::string const idf =
      "Shading:Building:Detailed,LEDGE;ShadingProperty:Reflectance,LEDGE,0.5,0.5,0;";
  Wall wall(idf, {ledge()});
  auto const light = wall.at(beam_alone, 0.2);
  EXPECT_NEAR(light.by_shades, beam_alone.open_ground() * 0.5 * 0.5, 0.005 * light.by_shades);
  EXPECT_LT(light.by_ground, 0.01 * light.by_shades);
}

TEST(ReflectedIrradiance, GlazedLedgeShowsTheSky) {
  std::string const idf =
      "Shading:Building:Detailed,LEDGE;ShadingProperty:Reflectance,LEDGE,0.5,0.5,1;";
  Wall wall(idf, {ledge()}, {{"LEDGE", 1.0}});
  SkyWeather const sky{high_sun.towards_sun, 0.0, 100.0, 80};
  EXPECT_NEAR(wall.at(sky, 0.2).by_shades, 50.0, 0.3);
}

TEST(ReflectedIrradiance, ScheduledShadeDimsInProportionBetweenItsStates) {
  // It covers the wall, and lets pass what its schedule says.
  std::string const idf =
      "Shading:Building:Detailed,SHEET,CLOTH;"
      "ShadingProperty:Reflectance,SHEET,0,0,0;";
  Wall wall(idf, {surface_of(
                     "SHEET",
                     {{-far, -0.01, far}, {-far, -0.01, 0}, {far, -0.01, 0}, {far, -0.01, far}})});
  double const open = Wall().at(high_sun, 0.2).sum();
  for (double const share : {0.0, 0.25, 0.4, 1.0}) {
    wall.schedule = share;
    EXPECT_NEAR(wall.at(high_sun, 0.2).sum(), share * open, 0.02 * open) << share;
  }
}

TEST(ReflectedIrradiance, ReflectanceOfOwnGroundIsNever0) {
  EXPECT_EQ(ground_reflectance(0.0, 500.0, 0.5), 1e-9);
  EXPECT_DOUBLE_EQ(ground_reflectance(50.0, 500.0, 0.5), 0.2);
  EXPECT_DOUBLE_EQ(ground_reflectance(1000.0, 500.0, 0.5), 4.0);
}

}  // namespace
}  // namespace gpu_shading::energyplus
