#include <gmock/gmock.h>

#include "model/energyplus_rays.h"
#include "model/idf/model_file.h"

namespace gpu_shading::energyplus {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string const shades =
    "GPUShading:TransparentShade,Canopy,Glass,Constant,0.5;"
    "GPUShading:PerforatedScreen,Veil,Screen,Round,,,0.005,,0.008,,0.003;"
    "GPUShading:Geometry,Tree,tree.obj;"
    "GPUShading:SiteContext,Town,town.geojson;";

using Surfaces = std::vector<std::string>;

std::vector<std::string> warnings(std::string const& idf) {
  auto const objects = read_idf(idf);
  return warn_of_rays(objects, read_shading_input(objects));
}

TEST(RayWarnings, OneForEachUserAndTypeOfShade) {
  auto const opaque = " as opaque, except for their Transmittance Schedules";
  EXPECT_THAT(
      warnings(shades + "Daylighting:Controls,Lamp;Building,B,,,,,FullExteriorWithReflections;"
                        "Construction:ComplexFenestrationState,Blind;"),
      ElementsAre("rays of daylighting (Daylighting:Controls Lamp) treat the surfaces of "
                  "GPUShading:TransparentShade Canopy" +
                      std::string(opaque),
                  "rays of daylighting (Daylighting:Controls Lamp) treat the surfaces of "
                  "GPUShading:PerforatedScreen Veil" +
                      std::string(opaque),
                  "rays of daylighting (Daylighting:Controls Lamp) do not see "
                  "GPUShading:Geometry Tree",
                  "rays of daylighting (Daylighting:Controls Lamp) do not see "
                  "GPUShading:SiteContext Town",
                  "rays of complex fenestration (Construction:ComplexFenestrationState Blind) "
                  "treat the surfaces of GPUShading:TransparentShade Canopy" +
                      std::string(opaque),
                  "rays of complex fenestration (Construction:ComplexFenestrationState Blind) "
                  "treat the surfaces of GPUShading:PerforatedScreen Veil" +
                      std::string(opaque),
                  "rays of complex fenestration (Construction:ComplexFenestrationState Blind) "
                  "do not see GPUShading:Geometry Tree",
                  "rays of complex fenestration (Construction:ComplexFenestrationState Blind) "
                  "do not see GPUShading:SiteContext Town",
                  "rays of solar reflections (Building, Solar Distribution) treat the surfaces "
                  "of GPUShading:TransparentShade Canopy as opaque",
                  "rays of solar reflections (Building, Solar Distribution) treat the surfaces "
                  "of GPUShading:PerforatedScreen Veil as opaque",
                  "rays of solar reflections (Building, Solar Distribution) do not see "
                  "GPUShading:Geometry Tree",
                  "rays of solar reflections (Building, Solar Distribution) do not see "
                  "GPUShading:SiteContext Town"));
}

TEST(RayWarnings, NoneWithoutRaysOrWithoutShades) {
  EXPECT_THAT(warnings(shades + "Building,B,,,,,FullExterior;"), IsEmpty());
  EXPECT_THAT(warnings("Daylighting:Controls,Lamp;Building,B,,,,,FullExteriorWithReflections;"
                       "Shading:Site:Detailed,Tree;"),
              IsEmpty());
}

TEST(RayWarnings, AnsweredDaylightingNamesOnlyWhatStaysInTheInput) {
  auto const objects = read_idf(shades + "Daylighting:Controls,Lamp;");
  auto const input = read_shading_input(objects);
  EXPECT_THAT(warn_of_rays(objects, input, Surfaces{}), IsEmpty());
  EXPECT_THAT(
      warn_of_rays(objects, input, Surfaces{"CANOPY", "SCREEN"}),
      ElementsAre("rays of daylighting (Daylighting:Controls Lamp) treat surfaces that stay "
                  "in EnergyPlus's input as opaque, except for their Transmittance Schedules: "
                  "CANOPY, SCREEN"));
}

TEST(RayWarnings, ManyNamesAreCut) {
  std::string idf = "DaylightingDevice:Shelf,Shelf;";
  for (auto const* name : {"A", "B", "C", "D", "E", "F", "G"}) {
    idf += "GPUShading:Geometry," + std::string(name) + ",a.obj;";
  }
  EXPECT_THAT(warnings(idf),
              ElementsAre("rays of daylighting (DaylightingDevice:Shelf Shelf) do not "
                          "see GPUShading:Geometry A, B, C, D, E and 2 more"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
