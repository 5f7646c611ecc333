#include "scene/shade_optics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "gpu_shading/error.h"
#include "gpu_shading/transmittance.h"
#include "model/idf/model_file.h"
#include "support/refusal.h"

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
  model.screens = read_perforated_screens(objects, model.shading, model.shades, {});
  return model;
}

Surface applied(ShadeOptics const& optics, std::string const& name) {
  Surface surface;
  surface.name = name;
  surface.polygon.outline = {{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {1, 0, 1}};
  optics.apply(surface);
  return surface;
}

double transmittance(ShadeOptics const& optics, std::string const& name) {
  constexpr double angle = 0.3;
  return (*applied(optics, name).filter.find<AngularTransmittance>()->model)(angle);
}

PerforatedSheet sheet(ShadeOptics const& optics, std::string const& name) {
  return *applied(optics, name).filter.find<PerforatedSheet>();
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
  EXPECT_FALSE(applied(optics, "NEVER").filter.find<AngularTransmittance>());
  EXPECT_EQ(applied(optics, "NEVER").filter.schedule, -1);
  EXPECT_NEAR(transmittance(optics, "HALF"), 0.5, 1e-12);
  EXPECT_EQ(applied(optics, "OPEN").casting, Casting::never);
  EXPECT_EQ(applied(optics, "LEAVES").filter.schedule, 0);
  EXPECT_EQ(applied(optics, "MORE LEAVES").filter.schedule, 0);
  EXPECT_EQ(applied(optics, "PLAIN").casting, Casting::always);
  EXPECT_EQ(optics.factors(), std::vector<double>{0.3});
}

TEST(ShadeOptics, ScheduleTimesTransparentShade) {
  auto const model =
      model_of(std::string(surfaces) + "GPUShading:TransparentShade,S,*,Constant,0.8;");
  auto given = values();
  ShadeOptics optics(model, given.schedules());
  EXPECT_FALSE(applied(optics, "NEVER").filter.find<AngularTransmittance>());
  EXPECT_NEAR(transmittance(optics, "HALF"), 0.4, 1e-12);
  EXPECT_NEAR(transmittance(optics, "OPEN"), 0.8, 1e-12);
  EXPECT_NEAR(transmittance(optics, "LEAVES"), 0.8, 1e-12);
  EXPECT_EQ(applied(optics, "LEAVES").filter.schedule, 0);
  EXPECT_NEAR(transmittance(optics, "PLAIN"), 0.8, 1e-12);
}

TEST(ShadeOptics, OverriddenConstantIsFollowedFromThenOn) {
  auto const model = model_of(surfaces);
  auto given = values();
  ShadeOptics optics(model, given.schedules());
  given.now["ZERO"] = 0.25;
  EXPECT_TRUE(optics.update({5, 2}));
  EXPECT_EQ(applied(optics, "NEVER").filter.schedule, 1);
  EXPECT_EQ(optics.factors(), (std::vector<double>{0.3, 0.25}));
  given.now["ZERO"] = 0.0;
  EXPECT_FALSE(optics.update({5, 3}));
  EXPECT_EQ(optics.factors(), (std::vector<double>{0.3, 0.0}));
}

std::string screen(std::string const& name, std::string const& surface,
                   std::string const& deployment = "") {
  return "GPUShading:PerforatedScreen," + name + "," + surface +
         ",Round,,,0.005,,0.008,,0.003,,,,,,,,0.25,,," + deployment + ";";
}

TEST(ShadeOptics, ScreensAndTheirDeployments) {
  auto const model = model_of(surfaces + screen("A", "Plain") + screen("B", "*Leaves", "Sails") +
                              screen("C", "Half", "Sails") + screen("D", "Open", "Other"));
  auto given = values();
  given.ranges["SAILS"] = {0.0, 0.9};
  given.ranges["OTHER"] = {1.0, 1.0};
  given.now["SAILS"] = 0.4;
  given.now["OTHER"] = 1.0;
  ShadeOptics optics(model, given.schedules());
  EXPECT_EQ(sheet(optics, "PLAIN").screen->pattern()->perforation().size, 0.005);
  EXPECT_EQ(sheet(optics, "PLAIN").placement.origin_u, 0.25);
  EXPECT_EQ(sheet(optics, "PLAIN").deployment, -1);
  EXPECT_EQ(sheet(optics, "LEAVES").screen, sheet(optics, "MORE LEAVES").screen);
  EXPECT_EQ(applied(optics, "LEAVES").filter.schedule, 0);
  EXPECT_EQ(sheet(optics, "LEAVES").deployment, sheet(optics, "HALF").deployment);
  EXPECT_NEAR(transmittance(optics, "HALF"), 0.5, 1e-12);
  // Its schedule lets all through, its screen does not.
  EXPECT_EQ(applied(optics, "OPEN").casting, Casting::always);
  EXPECT_FALSE(applied(optics, "NEVER").filter.find<PerforatedSheet>());

  auto const share = [&](std::string const& name) {
    return optics.deployments().at(static_cast<std::size_t>(sheet(optics, name).deployment));
  };
  EXPECT_EQ(share("LEAVES"), 0.9) << "before the first moment";
  EXPECT_FALSE(optics.update({5, 2}));
  EXPECT_EQ(share("LEAVES"), 0.4);
  EXPECT_EQ(share("OPEN"), 1.0);
  EXPECT_FALSE(optics.update({}));
  EXPECT_EQ(share("LEAVES"), 0.9) << "of the whole simulation the largest";
}

TEST(ShadeOptics, NothingPassesAScreenWhoseScheduleIsZero) {
  auto const model = model_of(surfaces + screen("A", "Never"));
  auto given = values();
  ShadeOptics const optics(model, given.schedules());
  EXPECT_FALSE(applied(optics, "NEVER").filter.find<PerforatedSheet>());
  EXPECT_FALSE(applied(optics, "NEVER").filter.find<AngularTransmittance>());
  EXPECT_EQ(applied(optics, "NEVER").casting, Casting::always);
}

TEST(ShadeOptics, ScreenOfASurfaceWithoutAreaIsLeftOut) {
  auto const model = model_of(surfaces + screen("A", "Plain"));
  auto given = values();
  ShadeOptics const optics(model, given.schedules());
  Surface surface;
  surface.name = "PLAIN";
  optics.apply(surface);
  EXPECT_FALSE(surface.filter.find<PerforatedSheet>());
  EXPECT_EQ(describe_optics(model, surface), "opaque");
}

TEST(ShadeOptics, MissingScheduleIsSaidWithItsField) {
  auto const refusal = [](std::string const& idf) {
    auto const model = model_of(idf);
    Schedules const none{[](std::string const& name) -> std::pair<double, double> {
                           throw Error("EnergyPlus has no schedule \"" + name + "\"");
                         },
                         {}};
    return refusal_of([&] { ShadeOptics const optics(model, none); });
  };
  EXPECT_EQ(refusal("Shading:Site:Detailed,Tree,Leaves;"),
            "Shading:Site:Detailed TREE: Transmittance Schedule Name: EnergyPlus has no schedule "
            "\"LEAVES\"");
  EXPECT_EQ(refusal("Shading:Site:Detailed,Tree;" + screen("A", "Tree", "Sails")),
            "GPUShading:PerforatedScreen A: Deployment Schedule Name: EnergyPlus has no schedule "
            "\"SAILS\"");
}

TEST(ShadeOptics, DescriptionsOfScreens) {
  auto const model = model_of(surfaces + screen("B", "Leaves", "Sails"));
  Surface surface;
  surface.name = "LEAVES";
  surface.polygon.outline = {{0, 0, 1}, {0, 0, 0}, {1, 0, 0}};
  EXPECT_THAT(describe_optics(model, surface),
              testing::HasSubstr("35.4 % open, 3 mm thick) deployed by SAILS x schedule YEAR"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
