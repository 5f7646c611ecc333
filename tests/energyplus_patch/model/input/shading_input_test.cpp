#include "model/input/shading_input.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

ShadingInput read(std::string const& idf) { return read_shading_input(read_idf(idf)); }

TEST(ShadingInput, ShadingSurfacesGetTheNamesThatEnergyPlusGivesThem) {
  auto const input = read(
      "Shading:Site:Detailed,Tree,Leaves,3,0,0,0,1,0,0,1,1,0;"
      "Window,W 1,Glass,South Wall;"
      "Shading:Overhang,Hood,w 1,0.1,90,0,0,0.6;"
      "Shading:Fin,Blade,W 1;");
  ASSERT_EQ(input.shading_surfaces.size(), 4U);
  EXPECT_EQ(input.shading_surfaces.at("TREE").transmittance_schedule, "LEAVES");
  for (auto const* name : {"HOOD", "BLADE Left", "BLADE Right"}) {
    EXPECT_TRUE(input.shading_surfaces.contains(name)) << name;
  }
}

TEST(ShadingInput, ShadingFractionsAreWantedOnlyWhereTheyAreUsed) {
  std::string const surfaces =
      "Shading:Building:Detailed,A;Shading:Building:Detailed,B;Shading:Building:Detailed,C;"
      "Shading:Building:Detailed,D;";
  EXPECT_FALSE(read(surfaces).wants("A"));
  auto const named = read(surfaces +
                          "Output:Variable,a,Surface Outside Face Sunlit Fraction;"
                          "Generator:Photovoltaic,PV,b;"
                          "Generator:PVWatts,W,5,1000,Standard,FixedOpenRack,0.14,Surface,,,d;"
                          "GPUShading:TransparentShade,Glass,C,Constant,0.5;");
  EXPECT_TRUE(named.wants("A"));
  EXPECT_TRUE(named.wants("B"));
  EXPECT_TRUE(named.wants("D"));
  EXPECT_FALSE(named.wants("C"));
  EXPECT_TRUE(
      read(surfaces + "Building,X,0,City,0.04,0.4,FullExteriorWithReflections;").wants("C"));
  EXPECT_TRUE(read(surfaces + "ShadowCalculation,PolygonClipping,,,,,,,Yes;").wants("C"));
}

TEST(ShadingInput, OutputsNameSurfacesByPatternsAndMirroredCopiesToo) {
  std::string const surfaces =
      "Shading:Building:Detailed,Fin 1;Shading:Building:Detailed,Fin 2;"
      "Shading:Building:Detailed,Roof;";
  auto const by_name =
      read(surfaces + "Output:Variable,mir-fin 1,Surface Outside Face Sunlit Fraction;");
  EXPECT_FALSE(by_name.wants("FIN 1"));
  EXPECT_TRUE(by_name.wants("Mir-FIN 1"));
  EXPECT_TRUE(by_name.receives("Mir-FIN 1"));
  EXPECT_FALSE(by_name.receives("Mir-FIN 2"));
  EXPECT_TRUE(by_name.mirrored_shown());
  auto const pattern =
      read(surfaces + "Output:Variable,(Mir-)?fin.*,Surface Outside Face Sunlit Fraction;");
  for (auto const* name : {"FIN 1", "FIN 2", "Mir-FIN 1", "Mir-FIN 2"}) {
    EXPECT_TRUE(pattern.wants(name)) << name;
  }
  EXPECT_FALSE(pattern.wants("ROOF"));
  EXPECT_FALSE(read(surfaces + "Output:Variable,Fin 1,Surface Outside Face Sunlit Fraction;")
                   .mirrored_shown());
  auto const all = read(surfaces + "Output:Variable,*,Surface Outside Face Sunlit Fraction;");
  EXPECT_TRUE(all.mirrored_shown());
  EXPECT_TRUE(all.wants("ROOF") && all.wants("Mir-ROOF"));
  EXPECT_FALSE(all.names("ROOF"));  // not by its own name
  // What cannot be interpreted may name any surface.
  auto const broken = read(surfaces + "Output:Variable,Fin[,Surface Outside Face Sunlit Fraction;");
  EXPECT_TRUE(broken.wants("ROOF"));
}

TEST(ShadingInput, OutputsOfAllSurfacesWantShadingSurfacesWhereTheyDependOnShading) {
  std::string const roof = "Shading:Building:Detailed,Roof;";
  for (auto const* output : {
           "Output:Variable,,surface outside face sunlit area,Hourly;",
           "Output:Variable,*,Surface Outside Face Incident Sky Diffuse Solar Radiation Rate per "
           "Area;",
           "Output:Variable,*,Surface Anisotropic Sky Multiplier;",
           "Output:Table:TimeBins,*,Surface Outside Face Sunlit Fraction,0,0.2,5;",
           "Output:Table:Monthly,Suns,2,Zone Mean Air Temperature,SumOrAverage,"
           "Surface Outside Face Sunlit Fraction,SumOrAverage;",
           "Output:Table:Annual,Suns,,,Surface Outside Face Sunlit Fraction,SumOrAverage,2;",
       }) {
    EXPECT_TRUE(read(roof + output).wants("Mir-ROOF")) << output;
  }
  for (auto const* output : {
           "Output:Variable,*,Surface Inside Face Temperature;",
           "Output:Variable,South,Surface Outside Face Sunlit Fraction;",
           "Output:Table:Monthly,Warmth,2,Surface Inside Face Temperature,SumOrAverage;",
       }) {
    EXPECT_FALSE(read(roof + output).wants("ROOF")) << output;
  }
}

TEST(ShadingInput, ReflectanceBelongsToItsSurfaceWhereverItStands) {
  auto const input = read_shading_input(
      read_idf("ShadingProperty:Reflectance,tree,0.35,0.4,0.25,Glass;Shading:Site:Detailed,Tree,;"
               "Shading:Site:Detailed,Wall,;ShadingProperty:Reflectance,Wall,7,,;"
               "Shading:Site:Detailed,Plain,;ShadingProperty:Reflectance,Nothing,0.5;"));
  auto const& tree = input.shading_surfaces.at("TREE");
  EXPECT_EQ(tree.reflectance, 0.35);
  EXPECT_EQ(tree.visible_reflectance, 0.4);
  EXPECT_EQ(tree.glazed, 0.25);
  EXPECT_EQ(input.shading_surfaces.at("WALL").reflectance, 1.0);
  EXPECT_EQ(input.shading_surfaces.at("PLAIN").reflectance, 0.2);
  EXPECT_EQ(input.shading_surfaces.at("PLAIN").visible_reflectance, 0.2);
  EXPECT_EQ(input.shading_surfaces.at("PLAIN").glazed, 0.0);
}

TEST(ShadingInput, OnlyExteriorSurfacesCast) {
  auto const input = read(
      "BuildingSurface:Detailed,Out,Wall,C,Z,,Outdoors;BuildingSurface:Detailed,In,Wall,C,Z,,"
      "Surface;"
      "Floor:Detailed,Slab,C,Z,,Ground;Wall:Adiabatic,Party,C,Z;Roof,Top,C,Z;"
      "FenestrationSurface:Detailed,Door,Door,C,In;Window,Pane,G,Out;Shading:Site:Detailed,Tree;");
  for (auto const* name : {"OUT", "TOP"}) {
    EXPECT_EQ(input.casting(name), Casting::turned_away) << name;
  }
  for (auto const* name : {"IN", "SLAB", "PARTY", "DOOR", "PANE"}) {
    EXPECT_EQ(input.casting(name), Casting::never) << name;
  }
  for (auto const* name : {"TREE", "PANE reveal 1"}) {
    EXPECT_EQ(input.casting(name), Casting::always) << name;
  }
}

TEST(ShadingInput, ShadowCalculation) {
  auto const input = read(
      "ShadowCalculation,PixelCounting,Periodic,20,15000,,1024,,No,Yes,No,Lower,Upper;"
      "ZoneList,Lower,Z1,z2;ZoneList,Upper,Z3;");
  EXPECT_EQ(input.pixel_counting_resolution, 1024);
  EXPECT_TRUE(input.disable_within_groups);
  EXPECT_FALSE(input.disable_between_groups);
  EXPECT_EQ(input.shading_zone_groups, (std::vector<std::string>{"LOWER", "UPPER"}));
  EXPECT_EQ(input.zone_lists.at("LOWER"), (std::set<std::string>{"Z1", "Z2"}));
  for (auto const* const wrong : {"many", "0", "-1", "65537", "1e300"}) {
    EXPECT_THAT(refusal_of([&] {
                  read(std::string("ShadowCalculation,PixelCounting,,,,,") + wrong + ";");
                }),
                testing::HasSubstr(std::string("Pixel Counting Resolution is \"") + wrong +
                                   "\", expected a number from 1 to 65536"));
  }
  EXPECT_FALSE(read("ShadowCalculation,PolygonClipping,,,,,1024;").pixel_counting_resolution);
  EXPECT_FALSE(read("ShadowCalculation,,,,,,1024;").pixel_counting_resolution);
}

TEST(ShadingInput, WhatEnergyPlusMayAskFor) {
  auto const input = read(
      "BuildingSurface:Detailed,South,Wall,C,Z,,Outdoors,,SunExposed,WindExposed;"
      "BuildingSurface:Detailed,Party,Wall,C,Z,,Adiabatic,,NoSun,NoWind;"
      "FenestrationSurface:Detailed,Pane,Window,G,South;"
      "FenestrationSurface:Detailed,Inner,Window,G,Party;"
      "Shading:Building:Detailed,Used;Shading:Building:Detailed,Useless;"
      "Output:Variable,Used,Surface Outside Face Sunlit Fraction;");
  for (auto const* const name : {"SOUTH", "PANE", "USED"})
    EXPECT_TRUE(input.receives(name)) << name;
  for (auto const* const name : {"PARTY", "INNER", "USELESS"}) {
    EXPECT_FALSE(input.receives(name)) << name;
  }
}

Release const installed{"25.3.0", "the updater"};

std::string warning_of(std::string const& idf, Release const& energyplus = installed) {
  return check_supported(read(idf), "a.idf", energyplus);
}

TEST(ShadingInput, UserGivenFractionsAreRefused) {
  EXPECT_THROW(warning_of("ShadowCalculation,scheduled;"), Error);
  EXPECT_THROW(warning_of("ShadowCalculation,Imported;"), Error);
}

TEST(ShadingInput, OtherVersionsAreWarnedOf) {
  for (auto const* const same : {"", "Version,25.3;", "Version,25.3.0;"}) {
    EXPECT_EQ(warning_of(same), "");
  }
  for (auto const* const older : {"9.3", "9.10", "22.2", "24.1", "25.1.0"}) {
    EXPECT_THAT(
        warning_of(fmt::format("Version,{};ShadowCalculation,PolygonClipping;", older)),
        testing::AllOf(testing::StartsWith(fmt::format(
                           "a.idf: Version is {}, older than this EnergyPlus, 25.3", older)),
                       testing::HasSubstr("the updater")));
  }
  EXPECT_THAT(warning_of("Version,26.1;"),
              testing::AllOf(testing::HasSubstr("26.1, newer than this EnergyPlus"),
                             testing::Not(testing::HasSubstr("the updater"))));
}

TEST(ShadingInput, FieldsThatMovedAreRefused) {
  EXPECT_THAT(refusal_of([] { warning_of("Version,9.2;ShadowCalculation,,20,15000;"); }),
              "a.idf: ShadowCalculation: its fields changed in EnergyPlus 9.3, and the model's "
              "Version is 9.2: update the model with the updater");
  EXPECT_THAT(warning_of("Version,9.2;ShadowCalculation;"), testing::HasSubstr("older"));
  EXPECT_THAT(warning_of("Version,9.2;Building,A;"), testing::HasSubstr("older"));
  // Renamed only: the same in an IDF.
  EXPECT_THAT(warning_of("Version,22.2;SurfaceProperty:LocalEnvironment,E,Wall,Lit;"),
              testing::HasSubstr("older"));
  auto const renamed = read_shading_input(read_epjson(nlohmann::json::parse(R"({
    "Version": {"Version 1": {"version_identifier": "22.2"}},
    "SurfaceProperty:LocalEnvironment": {"E": {"exterior_surface_name": "Wall",
      "external_shading_fraction_schedule_name": "Lit"}}})")));
  EXPECT_THAT(refusal_of([&] { check_supported(renamed, "a.epJSON", installed); }),
              testing::HasSubstr("SurfaceProperty:LocalEnvironment: its fields changed in "
                                 "EnergyPlus 23.2"));
  EXPECT_NE(check_supported(renamed, "a.epJSON", {"23.1.0", ""}), "");
}

TEST(ShadingInput, ZoneListsThatDoNotExistAreRefused) {
  std::string const lists = "ZoneList,Lower,Z1;ShadowCalculation,,,,,,,,,";
  EXPECT_NO_THROW(read(lists + "Yes,No,lower;"));
  EXPECT_NO_THROW(read(lists + "No,No,Lowr;"));  // not read by EnergyPlus either
  for (auto const* const flags : {"Yes,No", "No,Yes"}) {
    EXPECT_EQ(
        refusal_of([&] { read(lists + flags + ",Lower,Lowr;"); }),
        "ShadowCalculation: Shading Zone Group 2 ZoneList Name is \"LOWR\", which no ZoneList "
        "of the model has; did you mean LOWER?");
  }
}

TEST(ShadingInput, NamesThatNoShadingSurfaceHasAreExplained) {
  auto const input = read(
      "BuildingSurface:Detailed,South Wall,Wall,C,Z,,Outdoors,,SunExposed,WindExposed;"
      "FenestrationSurface:Detailed,South Window,Window,G,South Wall;"
      "Shading:Building:Detailed,Screen;Shading:Building:Detailed,Tree;");
  auto const said = [&](std::string const& pattern) {
    return std::string(no_shading_surface("Surface Name", pattern, input).what());
  };
  EXPECT_EQ(
      said("Scren"),
      "Surface Name is \"Scren\", which no shading surface of the model matches; did you mean "
      "SCREEN?");
  EXPECT_EQ(said("Louvre"),
            "Surface Name is \"Louvre\", which no shading surface of the model matches");
  EXPECT_EQ(said("south window"),
            "Surface Name is \"south window\", which matches a window or door: expected a shading "
            "surface (Shading:...)");
  EXPECT_EQ(said("*wall"),
            "Surface Name is \"*wall\", which matches a wall, floor or roof: expected a shading "
            "surface (Shading:...)");
}

}  // namespace
}  // namespace gpu_shading::energyplus
