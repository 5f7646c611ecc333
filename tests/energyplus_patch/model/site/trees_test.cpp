#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <numbers>

#include "gpu_shading/local_axes.h"
#include "surroundings_test.h"

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;

class Trees : public SurroundingsTest {
 protected:
  Crown crown(std::string const& fields) {
    auto const found = read("Site:Location,Here,50,8,1,200;GPUShading:Tree,T," + fields + ";");
    return *found.casters.at(0).surface.filter.find<Crown>();
  }
};

// Mean over the disc of a sphere.
double through_sphere(double diameter, double extinction) {
  double const k = extinction * diameter;
  return 2.0 * (1.0 - (1.0 + k) * std::exp(-k)) / (k * k);
}

TEST_F(Trees, StandWhereTheyAreSaidTo) {
  auto const found = read("GPUShading:Tree,Oak,10,-20,1.5,8,6,2,Cone,0.4,Evergreen;");
  ASSERT_EQ(found.casters.size(), 7U);
  auto const& plan = found.casters[0].surface.polygon.outline;
  EXPECT_EQ(plan[0], glm::dvec3(7, -23, 3.5));
  EXPECT_EQ(plan[2], glm::dvec3(13, -17, 3.5));
  auto const* const crown = found.casters[0].surface.filter.find<Crown>();
  EXPECT_EQ(crown->shape, CrownShape::cone);
  EXPECT_EQ(crown->height, 6.0);
  EXPECT_EQ(crown->deployment, -1);
  // The trunk, up to the middle of the crown.
  for (std::size_t i = 1; i < 7; ++i) {
    auto const& side = found.casters[i].surface.polygon.outline;
    EXPECT_EQ(side[0].z, 1.5);
    EXPECT_EQ(side[2].z, 6.5);
    EXPECT_NEAR(std::hypot(side[0].x - 10, side[0].y + 20), 0.2, 1e-12);
    EXPECT_FALSE(found.casters[i].surface.filter.transmits());
  }
  EXPECT_EQ(found.types.at("OAK"), "GPUShading:Tree");
  EXPECT_THAT(found.remarks, ElementsAre(HasSubstr("GPUShading:Tree Oak: 1 tree; x 7.0 to 13.0")));
}

TEST_F(Trees, BlankDensitiesTransmitWhatWasMeasured) {
  auto const leaved = crown("0,0,0,8,6,2,Ellipsoid");
  EXPECT_NEAR(through_sphere(6.0, 0.5 * leaved.wood_density), 0.46, 1e-6);
  EXPECT_NEAR(through_sphere(6.0, 0.5 * (leaved.wood_density + leaved.leaf_density)), 0.03, 1e-6);
  // Of any shape: by a sphere of its volume.
  auto const cylinder = crown("0,0,0,8,4,3,Cylinder");
  double const sphere = std::cbrt(6.0 / pi * pi / 4.0 * 4.0 * 4.0 * 5.0);
  EXPECT_NEAR(through_sphere(sphere, 0.5 * cylinder.wood_density), 0.46, 1e-6);
  auto const given = crown("0,0,0,8,6,2,,0,,,1.2,0.1,Planophile");
  EXPECT_EQ(given.leaf_density, 1.2);
  EXPECT_EQ(given.wood_density, 0.1);
  EXPECT_EQ(given.leaf_angles, LeafAngles::planophile);
  auto const blank = crown("0,0,,8");
  EXPECT_EQ(blank.height, 6.0);
}

// The transmittance that Brown and Gillespie (Journal of Arboriculture 16, 1990, p. 158) and
// Gardner and Sydnor (Journal of the American Society for Horticultural Science 109, 1984, p. 494)
// measured in leaf and without, of crowns of the sizes that the densities come from.
TEST_F(Trees, GeneraTransmitAboutWhatWasMeasured) {
  struct Measured {
    char const* genus;
    double diameter;  // of a crown that is as high as wide, in m
    double in_leaf;
    double bare;
  };
  Measured const all[] = {
      {"Juglans", 12.5, 0.09, 0.72},       {"Acer platanoides", 12.1, 0.10, 0.75},
      {"Acer rubrum", 12.1, 0.31, 0.75},   {"Platanus", 12.2, 0.11, 0.46},
      {"betula pendula", 9.6, 0.20, 0.52}, {"Gleditsia", 10.8, 0.44, 0.79},
      {"Pyrus", 7.8, 0.25, 0.57},          {"Zelkova", 11.1, 0.39, 0.76}};
  double in_leaf = 0.0;
  double bare = 0.0;
  for (auto const& tree : all) {
    auto const found = crown(fmt::format("0,0,0,{0},{1},2,,0,,,,,,,,,{2}", tree.diameter + 2.0,
                                         tree.diameter, tree.genus));
    double const leaved =
        through_sphere(tree.diameter, 0.5 * (found.leaf_density + found.wood_density));
    double const leafless = through_sphere(tree.diameter, 0.5 * found.wood_density);
    EXPECT_NEAR(leaved, tree.in_leaf, 0.18) << tree.genus;
    EXPECT_NEAR(leafless, tree.bare, 0.24) << tree.genus;
    in_leaf += (leaved - tree.in_leaf) / std::size(all);
    bare += (leafless - tree.bare) / std::size(all);
  }
  EXPECT_NEAR(in_leaf, 0.0, 0.03);
  EXPECT_NEAR(bare, 0.0, 0.05);
}

TEST_F(Trees, GivenDensitiesAndCyclesComeBeforeThoseOfTheGenus) {
  auto const given = crown("0,0,0,8,6,2,,0,,,1.2,0.1,,,,,Picea abies");
  EXPECT_EQ(given.leaf_density, 1.2);
  EXPECT_EQ(given.wood_density, 0.1);
  EXPECT_EQ(given.deployment, -1);
  EXPECT_EQ(crown("0,0,0,8,6,2,,0,Deciduous,,,,,,,,Picea").deployment, 0);
  EXPECT_EQ(crown("0,0,0,8,6,2,,0,,,,,,,,,Tilia").deployment, 0);
  auto const wooden = crown("0,0,0,8,6,2,,0,,,,0.3,,,,,Tilia");
  EXPECT_NEAR(wooden.leaf_density + wooden.wood_density, 0.54, 1e-12);
}

TEST_F(Trees, OfAFileHaveTheirGenera) {
  auto const feature = [](std::string const& properties) {
    return R"({"type": "Feature", "properties": {)" + properties +
           R"(}, "geometry": {"type": "Point", "coordinates": [8, 50]}})";
  };
  write("park.geojson", R"({"type": "FeatureCollection", "features": [)" +
                            feature(R"("genus": "Picea")") + "," +
                            feature(R"("species": "Tilia cordata")") + "," +
                            feature(R"("taxon": "Quercus robur")") + "," +
                            feature(R"("genus": "Larix")") + "," + feature("") + "]}");
  auto const found = read(
      "Site:Location,Here,50,8,1,200;"
      "GPUShading:Tree,Park,,,,9,5,,,0,,,,,,park.geojson,,,Ulmus;");
  auto const in_leaf = [&](std::size_t i) {
    auto const& crown = *found.casters.at(i).surface.filter.find<Crown>();
    return crown.leaf_density + crown.wood_density;
  };
  EXPECT_NEAR(in_leaf(0), 0.79, 1e-12);
  EXPECT_NEAR(in_leaf(1), 0.54, 1e-12);
  EXPECT_NEAR(in_leaf(2), 0.37, 1e-12);
  double const sphere = std::cbrt(5.0 * 5.0 * 6.75);
  EXPECT_NEAR(through_sphere(sphere, 0.5 * in_leaf(3)), 0.03, 1e-6);
  EXPECT_NEAR(in_leaf(4), 0.41, 1e-12);
  EXPECT_EQ(found.casters[0].surface.filter.find<Crown>()->deployment, -1);
  EXPECT_EQ(found.casters[1].surface.filter.find<Crown>()->deployment, 0);
  EXPECT_THAT(found.remarks,
              ElementsAre(HasSubstr("1 of a genus of unknown density, such as Larix")));
}

// A tetrahedron of 4 x 4 x 3 m in a file becomes the outline of a crown of 6 x 6 x 6 m.
TEST_F(Trees, TakeTheirOutlineFromAMesh) {
  std::string const vertices = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 3\n";
  write("crown.obj", vertices + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  write("open.obj", vertices + "f 1 3 2\nf 1 2 4\nf 1 4 3\n");
  std::string const here = "Site:Location,Here,50,8,1,200;";
  std::string const tree = "GPUShading:Tree,T,10,0,0,8,6,2,Mesh,0,,,,,,,,G:*;";
  auto const found = read(here + "GPUShading:Geometry,G,crown.obj,m,Z;" + tree);
  ASSERT_EQ(found.casters.size(), 1U);  // the mesh itself casts no shadow
  auto const& surface = found.casters[0].surface;
  EXPECT_EQ(surface.polygon.outline[0], glm::dvec3(7, -3, 2));
  auto const* const crown = surface.filter.find<Crown>();
  ASSERT_NE(crown->mesh, nullptr);
  EXPECT_NEAR(crown->mesh->volume(), 8.0 / 6.0, 1e-12);
  double const sphere = std::cbrt(6.0 / pi * 6.0 * 6.0 * 6.0 / 6.0);
  EXPECT_NEAR(through_sphere(sphere, 0.5 * crown->wood_density), 0.46, 1e-6);
  EXPECT_THAT(refusal(here + "GPUShading:Geometry,G,open.obj,m,Z;" + tree),
              HasSubstr("GPUShading:Tree T: Crown Mesh Name: G:*: the edge from"));
  EXPECT_THAT(refusal(here + tree), HasSubstr("Crown Mesh Name: G:*: expected the name of a mesh"));
  EXPECT_THAT(refusal(here + "GPUShading:Tree,T,10,0,0,8,6,2,Cone,0,,,,,,,,G:*;"),
              HasSubstr("Crown Mesh Name"));
}

TEST_F(Trees, LeavesFollowTheSeasonOrASchedule) {
  auto const schedules = [&](std::string const& text) { return read(text).leaf_schedules; };
  std::string const north = "Site:Location,Here,50,8,1,200;";
  std::string const south = "Site:Location,There,-30,8,1,200;";
  EXPECT_THAT(schedules(north + "GPUShading:Tree,T,0,0,0,8;"),
              ElementsAre("GPU SHADING NORTHERN LEAVES"));
  EXPECT_THAT(schedules(south + "GPUShading:Tree,T,0,0,0,8;GPUShading:Tree,U,9,0,0,8;"),
              ElementsAre("GPU SHADING SOUTHERN LEAVES"));
  EXPECT_THAT(schedules("GPUShading:Tree,T,0,0,0,8,,,,,Evergreen;"), ElementsAre());
  EXPECT_THAT(schedules("GPUShading:Tree,T,0,0,0,8,,,,,,Mine;"), ElementsAre("MINE"));
}

char const* const town = R"({"type": "FeatureCollection", "features": [
  {"type": "Feature", "id": "node/1", "properties": {"natural": "tree", "height": "12 m",
    "diameter_crown": 7, "leaf_cycle": "evergreen"},
   "geometry": {"type": "Point", "coordinates": [8.001, 50.0]}},
  {"type": "Feature", "properties": {},
   "geometry": {"type": "MultiPoint", "coordinates": [[8.0, 50.001], [8.0, 49.999]]}},
  {"type": "Feature", "properties": {"building": "yes"},
   "geometry": {"type": "Polygon", "coordinates": [[[8, 50], [8.1, 50], [8.1, 50.1], [8, 50]]]}}]})";

TEST_F(Trees, OfAFileStandAtTheirPositions) {
  write("town.geojson", town);
  auto const found =
      read("Site:Location,Here,50,8,1,200;GPUShading:Tree,Town,,,,9,5,,,0,,,,,,town.geojson;");
  ASSERT_EQ(found.casters.size(), 3U);
  LocalAxes const axes({50, 8, 200});
  auto const expect_foot = [&](std::size_t i, double latitude, double longitude, double base) {
    auto const& plan = found.casters[i].surface.polygon.outline;
    auto const foot = axes.to_local({latitude, longitude, 200});
    EXPECT_NEAR(0.5 * (plan[0].x + plan[2].x), foot.x, 1e-6);
    EXPECT_NEAR(0.5 * (plan[0].y + plan[2].y), foot.y, 1e-6);
    EXPECT_NEAR(plan[0].z, foot.z + base, 1e-6);
  };
  expect_foot(0, 50.0, 8.001, 3.0);
  expect_foot(1, 50.001, 8.0, 2.25);
  expect_foot(2, 49.999, 8.0, 2.25);
  auto const* const first = found.casters[0].surface.filter.find<Crown>();
  EXPECT_EQ(first->height, 9.0);
  EXPECT_EQ(first->deployment, -1);
  EXPECT_EQ(found.casters[1].surface.filter.find<Crown>()->deployment, 0);
  EXPECT_EQ(found.casters[0].surface.name, "TOWN:NODE/1");
  EXPECT_THAT(found.remarks, ElementsAre(HasSubstr("Town: town.geojson: 3 trees")));
}

TEST_F(Trees, OfAFileStandOnTheTerrain) {
  write("town.geojson", town);
  write("hill.asc",
        "ncols 2\nnrows 2\nxllcorner 7.9\nyllcorner 49.9\ncellsize 0.1\n250 250\n250 250\n");
  auto const found = read(
      "Site:Location,Here,50,8,1,200;GPUShading:SiteContext,C,,,,,,,hill.asc,,20000;"
      "GPUShading:Tree,Town,,,,9,5,,,0,,,,,,town.geojson;");
  auto const& tree = found.casters.back().surface.polygon.outline;
  EXPECT_NEAR(tree[0].z, 50.0 + 2.25, 1e-2);
}

TEST_F(Trees, MistakesAreNamed) {
  write("town.geojson", town);
  write("bad.geojson", R"({"type": "Feature", "properties": {"height": -3},
    "geometry": {"type": "Point", "coordinates": [8, 50]}})");
  std::string const here = "Site:Location,Here,50,8,1,200;";
  EXPECT_THAT(refusal("GPUShading:Tree,T,0,0;"), HasSubstr("GPUShading:Tree T: Height"));
  EXPECT_THAT(refusal("GPUShading:Tree,T,0,,0,8;"), HasSubstr("GPUShading:Tree T: Y"));
  EXPECT_THAT(refusal(here + "GPUShading:Tree,T,0,0,0,8,,,,,,,,,,,,,Oak;"),
              HasSubstr("GPUShading:Tree T: Genus is Oak, expected one of Acacia, Acer, "));
  EXPECT_THAT(
      refusal(here + "GPUShading:Tree,T,0,0,0,8,6,9;"),
      HasSubstr("GPUShading:Tree T: Crown Base Height is 9 m, expected less than the height "
                "of 8 m"));
  EXPECT_THAT(refusal("GPUShading:Tree,T,0,0,0,8;"), HasSubstr("Site:Location is missing"));
  EXPECT_THAT(refusal(here + "GPUShading:Tree,T,1,,,8,,,,,,,,,,town.geojson;"),
              HasSubstr("with File Name"));
  EXPECT_THAT(refusal(here + "GPUShading:Tree,T,,,,,,,,,,,,,,town.geojson;"),
              HasSubstr("town.geojson: tree 2: Height"));
  EXPECT_THAT(refusal(here + "GPUShading:Tree,T,,,,8,,,,,,,,,,bad.geojson;"),
              HasSubstr("bad.geojson: feature 1: height is -3, expected more than 0"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
