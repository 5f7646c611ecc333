#include "model/input/moving_shades.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"

namespace gpu_shading::energyplus {
namespace {

constexpr char const* surfaces =
    "Shading:Building:Detailed,Slat 1;Shading:Building:Detailed,Slat 2;"
    "Shading:Building:Detailed,Mesh;Shading:Building:Detailed,City;";

std::vector<MovingShade> read_shades(std::string const& idf) {
  auto const objects = read_idf(surfaces + idf);
  return read_moving_shades(objects, read_shading_input(objects),
                            {{"MESH", "GPUShading:Geometry"}, {"CITY", "GPUShading:SiteContext"}});
}

void expect_error(std::string const& idf, std::string const& message) {
  EXPECT_THAT([&] { read_shades(idf); }, testing::ThrowsMessage<Error>(testing::HasSubstr(message)))
      << idf;
}

TEST(MovingShades, HaveDefaultsByMotion) {
  auto const shades = read_shades("GPUShading:MovingShade,Louvres,slat *,Rotate,,,,,,,,,,,,,Turn;");
  ASSERT_EQ(shades.size(), 1U);
  auto const& shade = shades.front();
  EXPECT_THAT(shade.surfaces, testing::ElementsAre("SLAT 1", "SLAT 2"));
  EXPECT_EQ(shade.maximum, 90.0);
  EXPECT_EQ(shade.step, 1.0);
  EXPECT_EQ(shade.rest, 0.0);
  EXPECT_EQ(shade.schedule, "TURN");
  EXPECT_EQ(shade.maximum_wind, std::nullopt);
  auto const folds =
      read_shades("GPUShading:MovingShade,S,Slat *,Fold,,1,0,0,,,,,,,,,T,,,,,12;").front();
  EXPECT_EQ(folds.unit(), "deg");
  EXPECT_EQ(folds.maximum, 90.0);
  EXPECT_EQ(folds.maximum_wind, 12.0);
  EXPECT_EQ(shade.describe(),
            "GPUShading:MovingShade Louvres: 2 surfaces, Rotate from 0 to 90 deg in steps of "
            "1, at rest at 0, by Schedule TURN");
}

TEST(MovingShades, RestWhereAnOptionSays) {
  auto shades = read_shades(
      "GPUShading:MovingShade,South=1,Slat 1,Rotate,,,,,,,,,,5,,,Turn;"
      "GPUShading:MovingShade,Awning,Slat 2,Extend,,0,-1,0,,,,,,,,,Share;");
  set_rest(shades, "--positions", "awning=0.25,South=1=42");
  EXPECT_EQ(shades[0].rest, 40.0);
  EXPECT_EQ(shades[1].rest, 0.25);
  auto const expect_refused = [&](std::string const& text, std::string const& message) {
    EXPECT_THAT([&] { set_rest(shades, "--positions", text); },
                testing::ThrowsMessage<Error>(testing::HasSubstr(message)))
        << text;
  };
  expect_refused("Awning", "--positions \"Awning\": expected NAME=POSITION");
  expect_refused("Awning=open", "--positions \"Awning=open\": expected NAME=POSITION");
  expect_refused("Awnings=0", "no such GPUShading:MovingShade; did you mean Awning?");
  expect_refused("Awning=1.5", "--positions \"Awning=1.5\": expected 0 to 1 share");
}

TEST(MovingShades, WrongOnesAreNamedWithFieldAndValue) {
  std::string const head = "GPUShading:MovingShade,S,";
  expect_error(head + "Blind,Rotate,,,,,,,,,,,,,T;",
               "GPUShading:MovingShade S: Surface Name is \"Blind\": no shading surface");
  expect_error(head + "Mesh,Rotate,,,,,,,,,,,,,T;", "MESH is a mesh, expected Motion Slide, or");
  expect_error(head + "City,Slide,,1,,,,,,,,,,,T;", "CITY is part of a GPUShading:SiteContext");
  expect_error(head + "Slat 1,Rotate,,,,,,,,,,,,,T;" + head + "Slat *,Rotate,,,,,,,,,,,,,T;", "S");
  expect_error(head + "Slat 1,Slide,,,,,,,,,,,,,T;", "Direction X, Y and Z are 0");
  expect_error(head + "Slat 1,Rotate,,1,0,0;", "expected blanks with Axis CentreLine");
  expect_error(head + "Slat 1,Rotate,,,,,,,,20,10,,,,T;", "Maximum Position is 10");
  expect_error(head + "Slat 1,Extend,,0,1,0,,,,0,2,,,,T;", "expected shares from 0 to 1");
  expect_error(head + "Slat 1,Fold,,1,0,0,,,,0,100,,,,T;", "expected -90 to 90 degrees for Fold");
  expect_error(head + "Slat 1,Fold,,,,,,,,,,,,,T;", "Direction X, Y and Z are 0");
  expect_error(head + "Slat 1,Rotate,,,,,,,,,,,,,T,,,,,-1;", "Maximum Wind Speed");
  expect_error(head + "Slat 1,Rotate,,,,,,,,,,0.001;", "Step is 0.001");
  expect_error(head + "Slat 1,Rotate,,,,,,,,,,,91;", "Position at Rest is 91");
  expect_error(head + "Slat 1,Rotate;", "Position Schedule Name");
  expect_error(head + "Slat 1,Rotate,,,,,,,,,,,,TrackSun,,,,,,,0.1;", "Tolerance");
  expect_error(head + "Slat 1,Rotate,,,,,,,,,,,,BlockBeam;", "Receiver Name");
  expect_error(head + "Slat 1,Slide,,0,1,0,,,,,,,,TrackSun;", "expected Motion Rotate");
}

}  // namespace
}  // namespace gpu_shading::energyplus
