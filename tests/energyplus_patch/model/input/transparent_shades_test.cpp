#include "model/input/transparent_shades.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "model/idf/model_file.h"
#include "platform/text.h"
#include "support/degree.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

constexpr char const* model =
    "Shading:Site:Detailed,Pane 1;Shading:Site:Detailed,Pane 2;Shading:Zone:Detailed,Fin,Wall;"
    "WindowMaterial:Glazing,Clear,SpectralAverage,,0.006,0.69,0.07,0.07,0.8,0.08,0.08,0,0.84,0.84,"
    "0.9;"
    "WindowMaterial:Gas,Air,Air,0.012;"
    "WindowMaterial:Glazing,Spectral,Spectral,Data,0.006;"
    "WindowMaterial:Glazing,Opal,SpectralAverage,,0.006,0.5,0.1,0.1,0.5,0.1,0.1,0,0.84,0.84,0.9,,"
    "Yes;"
    "WindowMaterial:SimpleGlazingSystem,Simple,2.0,0.4;"
    "Material,Brick,Rough,0.1;"
    "Construction,Single,Clear;Construction,Double,Clear,Air,Clear;Construction,Odd,Spectral;"
    "Construction,Milk,Opal;Construction,Rated,Simple;Construction,Wall,Brick;";

TransparentShades read(std::string const& shades) {
  auto const objects = read_idf(model + shades);
  return read_transparent_shades(objects, read_shading_input(objects), testing::TempDir());
}

std::shared_ptr<Transmittance const> model_of(FilterFactor const& factor) {
  return std::get<AngularTransmittance>(factor).model;
}

double tau(TransparentShades const& shades, std::string const& surface, double angle) {
  return (*model_of(shades.by_surface.at(surface).solar))(angle * degree);
}

std::string refusal(std::string const& shade) {
  return refusal_of([&] { read(shade); });
}

TEST(NamePattern, StarsStandForAnyRunWithoutRegardToCase) {
  EXPECT_TRUE(matches("pane 1", "PANE 1"));
  EXPECT_FALSE(matches("pane", "PANE 1"));
  EXPECT_TRUE(matches("pane*", "PANE"));
  EXPECT_TRUE(matches("*NE*1", "PANE 1"));
  EXPECT_FALSE(matches("*NE*2", "PANE 1"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("a*b*c", "axbxbxc"));
}

TEST(TransparentShades, EveryModelOfTheDictionary) {
  std::ofstream(std::filesystem::path(testing::TempDir()) / "tau.csv") << "0,0.8\n60,0.7\n90,0\n";
  EXPECT_NEAR(tau(read("GPUShading:TransparentShade,S,Pane 1,Constant,0.4;"), "PANE 1", 70), 0.4,
              1e-12);
  EXPECT_NEAR(tau(read("GPUShading:TransparentShade,S,Pane 1,PolynomialInDegrees,0.9,-0.01;"),
                  "PANE 1", 30),
              0.6, 1e-12);
  EXPECT_NEAR(tau(read("GPUShading:TransparentShade,S,Pane 1,PolynomialInCosine,0,0.5,0.25;"),
                  "PANE 1", 60),
              0.3125, 1e-12);
  EXPECT_NEAR(
      tau(read("GPUShading:TransparentShade,S,Pane 1,Table,0,0.8,60,0.7,90,0,,;"), "PANE 1", 60),
      0.7, 1e-12);
  EXPECT_NEAR(tau(read("GPUShading:TransparentShade,S,Pane 1,TableFile,tau.csv;"), "PANE 1", 60),
              0.7, 1e-12);
  EXPECT_NEAR(tau(read("GPUShading:TransparentShade,S,Pane 1,Construction,single;"), "PANE 1", 0),
              0.69, 1e-3);
  // Two equal panes: T^2 / (1 - R^2).
  EXPECT_NEAR(tau(read("GPUShading:TransparentShade,S,Pane 1,Construction,Double;"), "PANE 1", 0),
              0.69 * 0.69 / (1 - 0.07 * 0.07), 1e-3);
  EXPECT_GT(tau(read("GPUShading:TransparentShade,S,Pane 1,Construction,Rated;"), "PANE 1", 0),
            0.2);
}

// Engineering Reference: dirt enters the outer pane's transmittance before its angular properties
// are derived, and no other pane's.
TEST(TransparentShades, DirtIsOnTheOuterPane) {
  std::string const dirty =
      "WindowMaterial:Glazing,Dirty,SpectralAverage,,0.006,0.69,0.07,0.07,0.8,0.08,0.08,0,0.84,"
      "0.84,0.9,0.8;";
  auto const at = [&](std::string const& layers, double angle) {
    return tau(read(dirty + "Construction,Tested," + layers +
                    ";GPUShading:TransparentShade,S,Pane 1,Construction,Tested;"),
               "PANE 1", angle);
  };
  EXPECT_NEAR(at("Dirty", 0), 0.8 * 0.69, 1e-3);
  EXPECT_NEAR(at("Dirty,Air,Clear", 0), 0.8 * at("Clear,Air,Clear", 0), 1e-3);
  for (double const angle : {0.0, 40.0, 70.0}) {
    EXPECT_EQ(at("Clear,Air,Dirty", angle), at("Clear,Air,Clear", angle));
  }
  // An absorbing pane darkens by more at a slant than a factor would.
  EXPECT_LT(at("Dirty", 70), 0.8 * at("Clear", 70) - 2e-3);
}

TEST(TransparentShades, ConstructionsHaveVisibleTransmittance) {
  auto const visible = [](std::string const& construction, double angle, std::string const& more) {
    auto const shades =
        read(more + "GPUShading:TransparentShade,S,Pane 1,Construction," + construction + ";");
    return (*model_of(shades.by_surface.at("PANE 1").visible))(angle * degree);
  };
  std::string const tinted =
      "WindowMaterial:Glazing,Tinted,SpectralAverage,,0.006,0.3,0.05,0.05,0.8,0.08,0.08,0,0.84,"
      "0.84,0.9;Construction,Tinted,Tinted;Construction,Two,Tinted,Air,Tinted;";
  EXPECT_NEAR(visible("Tinted", 0, tinted), 0.8, 1e-3);
  EXPECT_NEAR(visible("Two", 0, tinted), 0.8 * 0.8 / (1 - 0.08 * 0.08), 1e-3);
  // Rated windows: the curve of the solar transmittance.
  std::string const rated =
      "WindowMaterial:SimpleGlazingSystem,Bright,1.4,0.4,0.7;Construction,Bright,Bright;"
      "WindowMaterial:SimpleGlazingSystem,Plain,1.4,0.4;Construction,Plain,Plain;";
  EXPECT_NEAR(visible("Bright", 0, rated), 0.7, 2e-3);
  double const ratio = visible("Bright", 0, rated) / visible("Plain", 0, rated);
  for (double const angle : {50.0, 75.0}) {
    EXPECT_NEAR(visible("Bright", angle, rated), ratio * visible("Plain", angle, rated), 1e-9);
  }
  // Other models have one transmittance.
  auto const shades = read("GPUShading:TransparentShade,S,Pane 1,Constant,0.4;");
  EXPECT_EQ(model_of(shades.by_surface.at("PANE 1").visible),
            model_of(shades.by_surface.at("PANE 1").solar));
}

TEST(TransparentShades, PatternNamesSeveralSurfaces) {
  auto const shades = read("GPUShading:TransparentShade,S,pane*,Constant,0.4;");
  EXPECT_EQ(shades.by_surface.size(), 2U);
  EXPECT_TRUE(shades.by_surface.contains("PANE 2"));
  EXPECT_FALSE(shades.by_surface.contains("FIN"));
}

TEST(TransparentShades, WhatScattersIsWarnedOf) {
  auto const shades = read("GPUShading:TransparentShade,S,Fin,Construction,Milk;");
  ASSERT_EQ(shades.warnings.size(), 1U);
  EXPECT_THAT(shades.warnings[0], HasSubstr("Opal"));
}

TEST(TransparentShades, ErrorsNameObjectFieldAndValue) {
  auto const shade = [](std::string const& rest) {
    return "GPUShading:TransparentShade,S," + rest;
  };
  for (auto const& [rest, words] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"Tree*,Constant,0.4;",
            {"TransparentShade S", "Surface Name", "Tree*", "no shading surface"}},
           {"Pane 1,Fresnel,0.4;", {"Transmittance Model", "Fresnel", "PolynomialInCosine"}},
           {"Pane 1,Constant,1.4;", {"1.4", "0 to 1"}},
           {"Pane 1,Constant,half;", {"Value 1", "half"}},
           {"Pane 1,Constant,0.4,0.5;", {"2 values"}},
           {"Pane 1,PolynomialInDegrees,1,0.1;", {"Value 1 to 2: ", "expected 0 to 1"}},
           {"Pane 1,PolynomialInCosine,1.5;", {"Value 1: ", "expected 0 to 1"}},
           {"Pane 1,Table,0,0.5,40;", {"pairs"}},
           {"Pane 1,Table,40,0.5,0,0.5;", {"TransparentShade S: Value 1 to 4: ", "increasing"}},
           {"Pane 1,Table,0,0.5,95,0.5;", {"Value 1 to 4: angle is 95 degrees"}},
           {"Pane 1,TableFile,missing.csv;", {"missing.csv"}},
           {"Pane 1,Construction,Nothing;", {"no Construction", "Nothing"}},
           {"Pane 1,Construction,Odd;", {"Spectral", "Optical Data Type"}},
           {"Pane 1,Construction,Wall;", {"Brick", "cannot be used"}},
           {"Pane 1,Constant;", {"Value 1 is blank"}},
       }) {
    auto const message = refusal(shade(rest));
    for (auto const& word : words) EXPECT_THAT(message, HasSubstr(word)) << rest;
  }
  EXPECT_THAT(refusal("GPUShading:TransparentShade,S,Pane*,Constant,0.4;"
                      "GPUShading:TransparentShade,T,Pane 2,Constant,0.5;"),
              HasSubstr("PANE 2 is named by S already"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
