#include <gtest/gtest.h>

#include "model/energyplus_rays.h"
#include "model/idf/model_file.h"

namespace gpu_shading::energyplus {
namespace {

bool answered(std::string const& idf) { return daylighting_can_be_answered(read_idf(idf)); }

TEST(Daylighting, AnyOfItsObjectsTracesRays) {
  EXPECT_TRUE(has_daylighting(read_idf("Daylighting:Controls,Light;")));
  EXPECT_TRUE(has_daylighting(read_idf("DaylightingDevice:Tubular,Tube;")));
  EXPECT_FALSE(has_daylighting(read_idf("Building,B,,,,,FullExterior;")));
}

TEST(Daylighting, OnlySplitFluxIsAnswered) {
  EXPECT_TRUE(answered("Daylighting:Controls,Light,Box,SplitFlux;Building,B,,,,,FullExterior;"));
  EXPECT_TRUE(answered("Daylighting:Controls,Light,Box;"));  // SplitFlux is the default
  EXPECT_TRUE(answered("Daylighting:Controls,Light;Building,B,,,,,FullExteriorWithReflections;"));
  EXPECT_FALSE(answered("Daylighting:Controls,Light,Box,delight;"));
  EXPECT_FALSE(answered("Daylighting:Controls,Light;Construction:ComplexFenestrationState,Blind;"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
