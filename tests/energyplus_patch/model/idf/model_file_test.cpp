
#include "model/idf/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gpu_shading/error.h"
#include "model/idf/idf_text.h"

namespace gpu_shading::energyplus {
namespace {

std::string rewritten(std::string const& text, Rewrite const& rewrite) {
  return rewrite_idf(text, parse_idf(text), rewrite);
}

using testing::HasSubstr;

Rewrite const pixel_counting{shading_method("PixelCounting")};
Rewrite const at_timesteps{shading_method("PixelCounting", "Timestep")};

std::vector<std::string> shadow_fields(std::string const& text) {
  for (auto const& object : parse_idf(text)) {
    if (object.type == "ShadowCalculation") return object.fields;
  }
  return {};
}

TEST(RewriteIdf, OnlyTheMethodChanges) {
  std::string const before = "Version,9.6;\n! note\n";
  std::string const after = "\nZone,A;  !- last\n";
  auto const text =
      rewritten(before + "ShadowCalculation,PolygonClipping,Periodic,7,15000,,,Detailed;" + after,
                pixel_counting);
  EXPECT_EQ(shadow_fields(text), (std::vector<std::string>{"PixelCounting", "Periodic", "7",
                                                           "15000", "", "", "Detailed"}));
  EXPECT_TRUE(text.starts_with(before));
  EXPECT_TRUE(text.ends_with(after));
}

TEST(RewriteIdf, ModelWithoutShadowCalculationGetsOne) {
  auto const text = rewritten("Version,9.6;", at_timesteps);
  EXPECT_EQ(shadow_fields(text), (std::vector<std::string>{"PixelCounting", "Timestep"}));
}

TEST(RewriteIdf, ExtensionObjectsAreTakenOut) {
  auto const text =
      rewritten("A,1;\nGPUShading:Settings,\n  1024;  !- Resolution\nB,2;", pixel_counting);
  EXPECT_THAT(text, Not(HasSubstr("GPUShading")));
  EXPECT_THAT(text, HasSubstr("A,1;"));
  EXPECT_THAT(text, HasSubstr("B,2;"));
}

std::ptrdiff_t line_of(std::string const& text, std::string const& word) {
  return std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(word)),
                    '\n');
}

TEST(RewriteIdf, WhatStaysKeepsItsLine) {
  for (std::string const shadow :
       {"ShadowCalculation;", "ShadowCalculation,PolygonClipping;",
        "ShadowCalculation,\n  PolygonClipping,  !- Method\n  Periodic;  !- Frequency\n",
        "ShadowCalculation,\n\n\n\n\n  PolygonClipping;",
        "ShadowCalculation,\n  PolygonClipping,\n  Periodic,\n  20,\n  15000,\n  ,\n  512;"}) {
    auto const model = "Version,9.6;\n" + shadow +
                       " ! note\nGPUShading:Settings,\n  1024;  !- Resolution\nA,1; "
                       "GPUShading:TransparentShade,\nS,L,Constant,0.5; B,2;\n\nC,3;";
    auto const text = rewritten(model, at_timesteps);
    for (auto const* const word : {"ShadowCalculation", "! note", "A,1", "B,2", "C,3"}) {
      EXPECT_EQ(line_of(text, word), line_of(model, word)) << word << " in\n" << text;
    }
    EXPECT_EQ(shadow_fields(text)[0], "PixelCounting");
    EXPECT_EQ(shadow_fields(text)[1], "Timestep");
    EXPECT_EQ(parse_idf(text).size(), 5U) << text;
  }
}

// EnergyPlus's parser takes quadratic time over blank lines before a comment.
TEST(RewriteIdf, RemovedObjectsLeaveNoRunsOfBlankLines) {
  std::string model = "A,1;\n";
  for (int i = 0; i < 1000; ++i) {
    model += i % 2 == 0 ? "GPUShading:TransparentShade,\n  S,\n  L,\n  Constant,\n  0.5;\n"
                        : "GPUShading:TransparentShade,S,L,Constant,0.5;  \n";
  }
  auto const text = rewritten(model + "! note\nB,2;", pixel_counting);
  EXPECT_EQ(text.find("\n\n\n"), std::string::npos);
  EXPECT_EQ(text.find("\n  \n"), std::string::npos);
}

TEST(ReadIdf, AByteOrderMarkIsSkipped) {
  auto const objects = parse_idf("\xEF\xBB\xBFVersion,9.6;");
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].type, "Version");
}

TEST(RewriteEpJson, OnlyTheMethodChanges) {
  auto model = nlohmann::json::parse(R"({"Version": {"Version 1": {"version_identifier": "9.6"}},
    "GPUShading:Settings": {"s": {"resolution": 256}},
    "ShadowCalculation": {"s": {"shading_calculation_method": "PolygonClipping",
                                "shading_calculation_update_frequency": 7}}})");
  auto expected = model;
  expected.erase("GPUShading:Settings");
  expected["ShadowCalculation"]["s"]["shading_calculation_method"] = "PixelCounting";
  rewrite_epjson(model, pixel_counting);
  EXPECT_EQ(model, expected);
}

TEST(RewriteEpJson, ModelWithoutShadowCalculationGetsOne) {
  auto model = nlohmann::json::object();
  rewrite_epjson(model, {shading_method("PolygonClipping", "Timestep")});
  ASSERT_EQ(model["ShadowCalculation"].size(), 1U);
  EXPECT_EQ(*model["ShadowCalculation"].begin(),
            (nlohmann::json{{"shading_calculation_method", "PolygonClipping"},
                            {"shading_calculation_update_frequency_method", "Timestep"}}));
}

TEST(ReadModel, BothFormatsGiveTheSameObjects) {
  auto const idf = read_idf(
      "shading:zone:detailed,Fin 1,Wall,Half,3,0,0,0.5,1,0,0,1,0,1;\n"
      "ZoneList,Pair,North,South;\nUnknown,x;\nGPUShading:Settings,256;");
  auto const json = read_epjson(nlohmann::json::parse(R"({
    "GPUShading:Settings": {"any": {"resolution": 256}},
    "Shading:Zone:Detailed": {"Fin 1": {"base_surface_name": "Wall",
                                        "transmittance_schedule_name": "Half",
                                        "number_of_vertices": 3, "vertices": [
      {"vertex_x_coordinate": 0, "vertex_y_coordinate": 0, "vertex_z_coordinate": 0.5},
      {"vertex_z_coordinate": 0, "vertex_y_coordinate": 0, "vertex_x_coordinate": 1},
      {"vertex_x_coordinate": 1, "vertex_y_coordinate": 0, "vertex_z_coordinate": 1}]}},
    "Unknown": {"x": {}},
    "ZoneList": {"Pair": {"zones": [{"zone_name": "North"}, {"zone_name": "South"}]}}})"));
  ASSERT_EQ(idf.size(), 3U);
  ASSERT_EQ(json.size(), 3U);
  EXPECT_EQ(idf[0].type, "Shading:Zone:Detailed");
  EXPECT_EQ(idf[0].fields, json[1].fields);
  EXPECT_EQ(idf[0].list, json[1].list);
  EXPECT_EQ(idf[1].list, (std::vector<std::string>{"North", "South"}));
  EXPECT_EQ(idf[1].list, json[2].list);
  EXPECT_EQ(idf[2]["resolution"], "256");
  EXPECT_EQ(json[0]["resolution"], "256");
}

TEST(ReadModel, ExtensionsThatDoNotExistAreErrors) {
  EXPECT_THROW(read_idf("GPUShading:Nonsense,1;"), Error);
  EXPECT_THROW(read_idf("GPUShading:Settings,1,idf,auto,,more;"), Error);
  EXPECT_THROW(read_epjson({{"GPUShading:Nonsense", {{"a", nlohmann::json::object()}}}}), Error);
  EXPECT_THROW(read_epjson({{"GPUShading:Settings", {{"a", {{"resolutoin", 5}}}}}}), Error);
}

}  // namespace
}  // namespace gpu_shading::energyplus
