#include "model/input/pv_modules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"

namespace gpu_shading::energyplus {
namespace {

constexpr char const* surfaces =
    "Shading:Building:Detailed,Row 1;Shading:Building:Detailed,Row 2;"
    "BuildingSurface:Detailed,Roof,Roof,C,Hall,,Outdoors,,SunExposed;"
    "BuildingSurface:Detailed,Floor,Floor,C,Hall,,Adiabatic,,NoSun;";

std::vector<PvModules> read_modules(std::string const& idf) {
  auto const objects = read_idf(surfaces + idf);
  return read_pv_modules(objects, read_shading_input(objects));
}

void expect_error(std::string const& idf, std::string const& message) {
  EXPECT_THAT([&] { read_modules(idf); },
              testing::ThrowsMessage<Error>(testing::HasSubstr(message)))
      << idf;
}

TEST(PvModules, HaveSixtyCellsAndThreeDiodesByDefault) {
  auto const all = read_modules("GPUShading:PVModules,M,row *,1.0,1.65;");
  ASSERT_EQ(all.size(), 1U);
  auto const& modules = all.front();
  EXPECT_THAT(modules.surfaces, testing::ElementsAre("ROW 1", "ROW 2"));
  EXPECT_EQ(modules.cells(), 60U);
  EXPECT_EQ(modules.describe(),
            "GPUShading:PVModules M: 2 surfaces, modules of 1 m x 1.65 m with 6 x 10 cells");
  EXPECT_EQ(modules.diodes, 3);
  EXPECT_EQ(modules.frame, 0.02);
  EXPECT_FALSE(modules.columns || modules.string_length || modules.half_cut);
  EXPECT_TRUE(read_modules("GPUShading:PVModules,M,Row 1,1,1,,,,,,,,,,,Yes;").front().half_cut);
  EXPECT_EQ(read_modules("GPUShading:PVModules,M,roof,1,1;").front().surfaces.front(), "ROOF");
}

TEST(PvModules, WrongOnesAreNamedWithFieldAndValue) {
  std::string const head = "GPUShading:PVModules,M,";
  expect_error(head + "Floor,1,1;",
               "GPUShading:PVModules M: Surface Name is \"Floor\": no exterior or shading surface");
  expect_error(head + "Row 3,1,1;", "did you mean ROW");
  expect_error(head + "Row 1,0,1;", "Module Width is \"0\"");
  expect_error(head + "Row 1,1,1,,6,10,4;", "Bypass Diodes is 4, expected a divisor of Cell");
  expect_error(head + "Row 1,1,1,,6,11,,,,,,,,Yes;",
               "Cell Rows is 11, expected an even number for Half Cut");
  expect_error(head + "Row 1,1,1,,,,,0.5;", "Frame Width is 0.5, expected less than half");
  expect_error(head + "Row 1,1,1;GPUShading:PVModules,N,Row*,1,1;", "ROW 1 is named by M already");
}

}  // namespace
}  // namespace gpu_shading::energyplus
