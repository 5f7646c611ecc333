#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "energyplus_patch/files/test_images.h"
#include "gpu_shading/local_axes.h"
#include "model/idf/model_file.h"
#include "model/model_reader.h"
#include "model/site/surroundings.h"
#include "model/site/texture_axes.h"
#include "surroundings_test.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

void expect_at(glm::dvec3 const& point, glm::dvec3 const& place) {
  EXPECT_NEAR(glm::distance(point, place), 0.0, 1e-6)
      << point.x << ' ' << point.y << ' ' << point.z;
}

// A triangle whose first corner tells the axes apart: (1, 2, 3).
class Geometry : public SurroundingsTest {
 protected:
  Geometry() {
    write("t.obj",
          "o T\nusemtl M\nv 1 2 3\nv 2 2 3\nv 1 3 3\nvt 0 0\nvt 1 0\nvt 0 2\nf 1/1 2/2 3/3\n");
    write("two.obj",
          "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 4 4 0\nvt 0 0\nvt 2 0\nvt 0 2\nvt 1 3\n"
          "o A\nusemtl M\nf 1/1 2/2 3/3\no B\nusemtl N\nf 1 2 3\no C\nusemtl N\nf 1/1 2/4 3/3\n");
  }

  Ring corners(std::string const& fields) {
    auto const found =
        read("Site:Location,Here,50,8,1,200;GPUShading:Geometry,G,t.obj," + fields + ";");
    EXPECT_EQ(found.casters.size(), 1U);
    return found.casters.at(0).surface.polygon.outline;
  }

  // For a whole model, with screens.
  Model understood(std::string const& text) {
    Choices choices;
    choices.folder = folder_.path();
    return understand(read_idf(text), folder_.path() / "model.idf", choices);
  }
};

TEST_F(Geometry, AxesAndUnits) {
  expect_at(corners("m,Z")[0], {1, 2, 3});
  expect_at(corners("m,Y")[0], {1, -3, 2});
  expect_at(corners("cm,z")[0], {0.01, 0.02, 0.03});
  expect_at(corners("mm,Z")[0], {0.001, 0.002, 0.003});
  expect_at(corners("ft,Z")[0], {0.3048, 0.6096, 0.9144});
  expect_at(corners("in,Y")[0], {0.0254, -0.0762, 0.0508});
}

TEST_F(Geometry, PlacedInWorldAxes) {
  expect_at(corners("m,Z,10,20,30")[0], {11, 22, 33});
  // The file's north, 2 m along it, points east.
  expect_at(corners("m,Z,10,20,30,,,,90")[0], {12, 19, 33});
  expect_at(corners("m,Y,,,,,,,-90")[0], {3, 1, 2});
}

TEST_F(Geometry, PlacedByLatitudeAndLongitude) {
  expect_at(corners("m,Z,,,,50,8")[0], {1, 2, 3});
  expect_at(corners("m,Z,,,,50,8,190,90")[0], {2, -1, -7});
  // 10 km to the east of the model its north has turned and its up leans.
  LocalAxes const world({50, 8, 200});
  GeographicPoint const there{50, 8.14, 200};
  LocalAxes const own(there);
  expect_at(corners("m,Z,,,,50,8.14")[0], world.to_local(own.to_geographic({1, 2, 3})));
}

TEST_F(Geometry, NamesAndWhatIsLeftOut) {
  auto const all = read("GPUShading:Geometry,Sail,two.obj,m,Z;");
  ASSERT_EQ(all.casters.size(), 3U);
  EXPECT_EQ(all.casters[0].surface.name, "SAIL:M:A");
  EXPECT_TRUE(all.types.contains("SAIL:N:B"));
  EXPECT_THAT(all.remarks.at(0), HasSubstr("Sail: two.obj: 3 meshes, 3 triangles; x 0.0 to 4.0"));
  auto const one = read("GPUShading:Geometry,Sail,two.obj,m,Z,,,,,,,,n:*;");
  EXPECT_EQ(one.casters.size(), 1U);
  EXPECT_THAT(one.remarks.at(0), HasSubstr("1 mesh, 1 triangles (2 left out)"));
}

TEST_F(Geometry, SaysWhatIsWrong) {
  auto const of = [&](std::string const& fields) {
    return refusal("GPUShading:Geometry,G," + fields + ";");
  };
  EXPECT_THAT(of(""), HasSubstr("GPUShading:Geometry G: File Name is blank"));
  EXPECT_THAT(of("t.skp"), HasSubstr("File Name: t.skp: expected an .obj"));
  EXPECT_THAT(of("none.obj,m,Z"), HasSubstr("none.obj: no such file"));
  EXPECT_THAT(of("t.obj"), HasSubstr("Unit is blank, expected m, cm, mm, in or ft"));
  EXPECT_THAT(of("t.obj,m"), HasSubstr("Up Axis is blank, expected Y or Z"));
  EXPECT_THAT(of("t.obj,m,X"), HasSubstr("Up Axis is \"X\""));
  EXPECT_THAT(of("t.glb,m"),
              HasSubstr("Unit is \"m\", expected blank with a file that states its"));
  EXPECT_THAT(refusal("Site:Location,Here,50,8,1,200;GPUShading:Geometry,G,t.obj,m,Z,,,,50;"),
              HasSubstr("Longitude is blank, expected degrees as Latitude is given"));
  EXPECT_THAT(of("t.obj,m,Z,,,,50,8"), HasSubstr("Site:Location is missing"));
  EXPECT_THAT(of("t.obj,m,Z,,,,,,5"), HasSubstr("Elevation is \"5\", expected blank without"));
  EXPECT_THAT(refusal("Site:Location,Here,50,8,1,200;GPUShading:Geometry,G,t.obj,m,Z,1,,,50,8;"),
              HasSubstr("X is \"1\", expected blank with Latitude"));
}

TEST(TextureAxes, AreTheAffineMap) {
  // u along +y in 2 m, v along -x in 0.5 m, (0, 0) at (3, 1, 0).
  auto const texture = [](glm::dvec3 const& p) {
    return glm::dvec2((p.y - 1) / 2, (3 - p.x) / 0.5);
  };
  std::array<glm::dvec3, 3> const corners{{{0, 0, 0}, {5, 1, 0}, {2, 4, 0}}};
  auto const axes =
      texture_axes(corners, {texture(corners[0]), texture(corners[1]), texture(corners[2])});
  ASSERT_TRUE(axes);
  expect_at(axes->origin, {3, 1, 0});
  expect_at(axes->u, {0, 2, 0});
  expect_at(axes->v, {-0.5, 0, 0});
  EXPECT_FALSE(texture_axes(corners, {glm::dvec2(0), glm::dvec2(1), glm::dvec2(2)}));
}

TEST_F(Geometry, ScreensLieAsTheTextureDoes) {
  write_texture("checks.png", 2, 1, 1, {1, 0});
  std::filesystem::copy(temporary("checks.png"), folder_.path() / "checks.png");
  auto const model = understood(
      "GPUShading:Geometry,G,t.obj,m,Z;"
      "GPUShading:PerforatedScreen,S,G:M:*,Texture,checks.png,,,,,,0.01;");
  auto const& caster = model.surroundings.casters.at(0);
  auto const& maker = model.screens.by_surface.at("G:M:T").maker;
  auto const tile = maker->make(caster.surface.polygon, caster.texture)->tile();
  ASSERT_TRUE(tile);
  // One unit of u is 1 m, of v half a metre.
  EXPECT_NEAR(tile->width(), 1.0, 1e-6);
  EXPECT_NEAR(tile->height(), 0.5, 1e-6);
  auto const axes =
      tile_axes(caster.surface.polygon, maker->placement(caster.surface.polygon, caster.texture));
  expect_at(axes.u, {1, 0, 0});
  expect_at(axes.v, {0, 1, 0});
  // Whole tiles away from the mesh's own (0, 0) at (1, 2, 3).
  EXPECT_NEAR(std::remainder(axes.origin.x - 1.0, 1.0), 0.0, 1e-6);
  EXPECT_NEAR(std::remainder(axes.origin.y - 2.0, 0.5), 0.0, 1e-6);

  auto const with = [&](std::string const& mesh) {
    return refusal_of([&] {
      understood("GPUShading:Geometry,G,two.obj,m,Z;GPUShading:PerforatedScreen,S," + mesh +
                 ",Round,,,0.01,,0.02,,0.001;");
    });
  };
  EXPECT_EQ(with("G:M:A"), "accepted");
  EXPECT_THAT(with("G:N:B"),
              HasSubstr("GPUShading:PerforatedScreen S: G:N:B has triangles without"));
  EXPECT_THAT(with("G:N:C"), HasSubstr("G:N:C: its texture's axes are at"));
  EXPECT_THAT(with("G:X:*"), HasSubstr("which no shading surface of the model matches"));
}

TEST_F(Geometry, AReversedTextureReadsFromTheOtherSide) {
  write("m.obj", "o T\nv 1 2 3\nv 2 2 3\nv 1 3 3\nvt 0 0\nvt -1 0\nvt 0 2\nf 1/1 2/2 3/3\n");
  auto const found = read("GPUShading:Geometry,G,m.obj,m,Z;");
  auto const& caster = found.casters.at(0);
  EXPECT_LT(normal(caster.surface.polygon).z, 0.0);
  EXPECT_GT(
      glm::dot(glm::cross(caster.texture->u, caster.texture->v), normal(caster.surface.polygon)),
      0.0);
}

}  // namespace
}  // namespace gpu_shading::energyplus
