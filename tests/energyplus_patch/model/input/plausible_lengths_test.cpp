#include "model/input/plausible_lengths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/idf/model_file.h"

namespace gpu_shading::energyplus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

auto warnings(std::string const& object) { return warn_of_lengths(read_idf(object)); }

TEST(PlausibleLengths, UnitsThatMayHaveBeenMeantAreListed) {
  std::string const sheet = "GPUShading:PerforatedScreen,S,L,Round,,Staggered60,";
  EXPECT_THAT(warnings(sheet + "0.9,,1,,0.001;"), IsEmpty());
  EXPECT_THAT(warnings(sheet + "5,,8,,0;"),
              ElementsAre("GPUShading:PerforatedScreen S: Hole Size is 5 m, more than 1 m: lengths "
                          "are in metres; is it in millimetres (0.005), centimetres (0.05), inches "
                          "(0.127)?",
                          HasSubstr("Pitch is 8 m")));
  // 40 inches and 60 centimetres are too long as well.
  EXPECT_THAT(warnings(sheet + "40,,0.5,,0;"),
              ElementsAre(testing::EndsWith("is it in millimetres (0.04), centimetres (0.4)?")));
}

TEST(PlausibleLengths, HeightsTreesAndModules) {
  EXPECT_THAT(warnings("GPUShading:SiteContext,Town,town.geojson,,,,3.5,12;"), IsEmpty());
  EXPECT_THAT(warnings("GPUShading:SiteContext,Town,town.geojson,,,,3500,9000;"),
              ElementsAre(HasSubstr("Town: Storey Height is 3500 m, more than 20 m"),
                          HasSubstr("Default Height is 9000 m, more than 1000 m")));
  EXPECT_THAT(warnings("GPUShading:Tree,Oak,2,-8,0,9,6;"), IsEmpty());
  EXPECT_THAT(warnings("GPUShading:Tree,Oak,2,-8,0,9,90;"),
              ElementsAre(HasSubstr("Oak: Crown Diameter is 90 m, more than 70 m")));
  EXPECT_THAT(warnings("GPUShading:PVModules,Row,PV,68,1.7;"),
              ElementsAre(HasSubstr("Row: Module Width is 68 m, more than 10 m")));
}

}  // namespace
}  // namespace gpu_shading::energyplus
