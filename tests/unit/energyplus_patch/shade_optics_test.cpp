#include "session/shade_optics.h"

#include <gtest/gtest.h>

#include <map>

#include "gpu_shading/transmittance.h"
#include "input/model_file.h"

namespace gpu_shading::energyplus {
namespace {

// Schedules that a test sets.
struct Values {
  std::map<std::string, std::pair<double, double>> ranges;
  std::map<std::string, double> now;

  Schedules schedules() {
    return {[this](std::string const& name) { return ranges.at(name); },
            [this](std::string const& name, Moment) { return now.at(name); }};
  }
};

Model model_of(std::string const& idf) {
  auto const objects = read_idf(idf);
  Model model;
  model.shading = read_shading_input(objects);
  model.shades = read_transparent_shades(objects, model.shading, {});
  return model;
}

Surface applied(ShadeOptics const& optics, std::string const& name) {
  Surface surface;
  surface.name = name;
  optics.apply(surface);
  return surface;
}

constexpr char const* surfaces =
    "Shading:Site:Detailed,Never,Zero;Shading:Site:Detailed,Half,Half;Shading:Site:Detailed,Open,"
    "One;"
    "Shading:Site:Detailed,Leaves,Year;Shading:Site:Detailed,More Leaves,Year;"
    "Shading:Site:Detailed,Plain;";

Values values() {
  return {{{"ZERO", {0.0, 0.0}}, {"HALF", {0.5, 0.5}}, {"ONE", {1.0, 1.0}}, {"YEAR", {0.1, 0.9}}},
          {{"ZERO", 0.0}, {"HALF", 0.5}, {"ONE", 1.0}, {"YEAR", 0.3}}};
}

TEST(ShadeOptics, ConstantSchedulesBecomeNumbersAndVaryingOnesFactors) {
  auto const model = model_of(surfaces);
  auto given = values();
  ShadeOptics optics(model, given.schedules());
  EXPECT_FALSE(optics.update({1, 1}));
  EXPECT_FALSE(applied(optics, "NEVER").transmittance);
  EXPECT_EQ(applied(optics, "NEVER").schedule, -1);
  EXPECT_NEAR((*applied(optics, "HALF").transmittance)(0.3), 0.5, 1e-12);
  EXPECT_EQ(applied(optics, "OPEN").casting, Casting::never);
  EXPECT_EQ(applied(optics, "LEAVES").schedule, 0);
  EXPECT_EQ(applied(optics, "MORE LEAVES").schedule, 0);
  EXPECT_EQ(applied(optics, "PLAIN").casting, Casting::always);
  EXPECT_EQ(optics.factors(), std::vector<double>{0.3});
}

TEST(ShadeOptics, ScheduleTimesTransparentShade) {
  auto const model =
      model_of(std::string(surfaces) + "GPUShading:TransparentShade,S,*,Constant,0.8;");
  auto given = values();
  ShadeOptics optics(model, given.schedules());
  EXPECT_FALSE(applied(optics, "NEVER").transmittance);
  EXPECT_NEAR((*applied(optics, "HALF").transmittance)(0.3), 0.4, 1e-12);
  EXPECT_NEAR((*applied(optics, "OPEN").transmittance)(0.3), 0.8, 1e-12);
  EXPECT_NEAR((*applied(optics, "LEAVES").transmittance)(0.3), 0.8, 1e-12);
  EXPECT_EQ(applied(optics, "LEAVES").schedule, 0);
  EXPECT_NEAR((*applied(optics, "PLAIN").transmittance)(0.3), 0.8, 1e-12);
}

TEST(ShadeOptics, OverriddenConstantIsFollowedFromThenOn) {
  auto const model = model_of(surfaces);
  auto given = values();
  ShadeOptics optics(model, given.schedules());
  given.now["ZERO"] = 0.25;
  EXPECT_TRUE(optics.update({5, 2}));
  EXPECT_EQ(applied(optics, "NEVER").schedule, 1);
  EXPECT_EQ(optics.factors(), (std::vector<double>{0.3, 0.25}));
  given.now["ZERO"] = 0.0;
  EXPECT_FALSE(optics.update({5, 3}));
  EXPECT_EQ(optics.factors(), (std::vector<double>{0.3, 0.0}));
}

}  // namespace
}  // namespace gpu_shading::energyplus
