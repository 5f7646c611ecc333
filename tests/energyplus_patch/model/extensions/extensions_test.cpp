#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu_shading/renderer.h"
#include "model/extensions/extension_fields.h"
#include "model/extensions/field.h"
#include "model/idf/extension_objects.h"
#include "model/idf/fields.h"
#include "model/idf/model_file.h"
#include "model/input/screen_maker.h"
#include "model/options/options.h"
#include "platform/text.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

std::string refusal(std::string const& idf) {
  return refusal_of([&] { check_unique(read_idf(idf)); });
}

std::string epjson_refusal(std::string const& text) {
  return refusal_of([&] { check_unique(read_epjson(parse_epjson(text))); });
}

TEST(Extensions, WhatAFieldHoldsIsDescribed) {
  EXPECT_EQ(expectation(extension::perforated_screen::hole_shape),
            "Texture, Round, Square, Slotted or Hexagonal");
  EXPECT_EQ(expectation(extension::perforated_screen::layers), "Auto or an integer from 1 to 64");
  EXPECT_EQ(expectation(extension::perforated_screen::thickness),
            "a number of at least 0 and below 1 m");
  EXPECT_EQ(expectation(extension::perforated_screen::hole_size), "a number from 1e-06 to 1000 m");
  EXPECT_EQ(expectation(extension::perforated_screen::surface_name), "text");
  EXPECT_EQ(expectation(extension::transparent_shade::value), "a number or text");
  FieldInfo const low{
      .key = "k", .title = "K", .kind = FieldKind::real, .minimum = Limit{2, false}};
  EXPECT_EQ(expectation(low), "a number of at least 2");
  FieldInfo const high{
      .key = "k", .title = "K", .kind = FieldKind::real, .maximum = Limit{2, true}, .units = "deg"};
  EXPECT_EQ(expectation(high), "a number below 2 deg");
  FieldInfo const any{.key = "k", .title = "K", .kind = FieldKind::real, .units = "m"};
  EXPECT_EQ(expectation(any), "a number in m");
}

TEST(Extensions, ValuesAreOfTheTypesOfTheirFields) {
  auto const screen = read_idf(
      "gpushading:perforatedscreen,S,Panel,ROUND,,straight,0.005,,0.008,,0.003,,12,,,,,,,,30;")[0];
  namespace field = extension::perforated_screen;
  EXPECT_EQ(screen.type, field::type);
  EXPECT_EQ(read(screen, field::hole_shape), field::HoleShape::round);
  EXPECT_EQ(read(screen, field::arrangement), field::Arrangement::straight);
  EXPECT_EQ(read(screen, field::hole_size), 0.005);
  EXPECT_EQ(read(screen, field::row_pitch), std::nullopt);
  EXPECT_EQ(std::get<int>(read(screen, field::layers)), 12);
  EXPECT_EQ(read(screen, field::tile_rotation), 30.0);
  // Defaults of the dictionary.
  EXPECT_EQ(read(screen, field::opacity_threshold), 0.5);
  EXPECT_EQ(read(screen, field::sheet_plane), field::SheetPlane::centre);
  EXPECT_EQ(read(screen, field::invert_opacity), field::InvertOpacity::no);

  auto const shade = read_idf("GPUShading:TransparentShade,S,P,Table,0,0.8,90,0,,;")[0];
  EXPECT_EQ(read(shade, extension::transparent_shade::value),
            (std::vector<std::string>{"0", "0.8", "90", "0"}));
}

TEST(Extensions, DictionaryAndLibraryHaveTheSameLimits) {
  EXPECT_EQ(extension::settings::error.minimum->value, RendererOptions::min_error);
  EXPECT_EQ(extension::settings::error.maximum->value, RendererOptions::max_error);
  EXPECT_EQ(parse_number(std::string(extension::settings::error.blank)), Options::default_error);
  EXPECT_EQ(parse_number(std::string(extension::perforated_screen::opacity_threshold.blank)),
            ScreenTexture{}.threshold);
}

TEST(Extensions, ErrorsNameObjectFieldValueAndWhatWasExpected) {
  std::string const screen = "GPUShading:PerforatedScreen,S,Panel,Round,,,";
  EXPECT_EQ(refusal(screen + "-1;"),
            "GPUShading:PerforatedScreen S: Hole Size is \"-1\", expected a number from "
            "1e-06 to 1000 m");
  EXPECT_EQ(refusal("GPUShading:PerforatedScreen,S,Panel,Oval;"),
            "GPUShading:PerforatedScreen S: Hole Shape is \"Oval\", expected Texture, Round, "
            "Square, Slotted or Hexagonal");
  EXPECT_EQ(refusal("GPUShading:PerforatedScreen,S,,Round;"),
            "GPUShading:PerforatedScreen S: Surface Name is blank, expected text");
  EXPECT_EQ(refusal("GPUShading:TransparentShade,S,Panel,Constant;"),
            "GPUShading:TransparentShade S: Value 1 is blank, expected a number or text");
  EXPECT_EQ(refusal("GPUShading:TransparentShade,S,Panel,Table,0,,90;"),
            "GPUShading:TransparentShade S: Value 2 is blank, expected a number or text");
  EXPECT_EQ(refusal("GPUShading:TransparentShade,,Panel,Constant,1;"),
            "GPUShading:TransparentShade: Name is blank, expected text");
  EXPECT_EQ(refusal("GPUShading:Settings,1,idf,auto,,,auto,more;"),
            "GPUShading:Settings: 7 fields, expected 6 at most");
  EXPECT_EQ(refusal("GPUShading:Nonsense,1;"),
            "GPUShading:Nonsense: no such object; known: GPUShading:Settings, "
            "GPUShading:TransparentShade, GPUShading:PerforatedScreen, GPUShading:MovingShade, "
            "GPUShading:SurroundingGroup, GPUShading:SiteContext, GPUShading:Geometry, "
            "GPUShading:Tree, GPUShading:PVModules");
  EXPECT_EQ(refusal("GPUShading:Settings,1;GPUShading:Settings,2;"),
            "GPUShading:Settings: given twice, expected once at most");
  EXPECT_EQ(refusal("GPUShading:Geometry,a,a.obj;GPUShading:Geometry,A,b.obj;"),
            "GPUShading:Geometry A: given twice, expected one object of this name");
  EXPECT_EQ(refusal("GPUShading:Geometry,a,a.obj;GPUShading:SiteContext,A;"), "accepted");
}

TEST(Extensions, NumbersThatAreNoneAreRefused) {
  for (auto const* const value :
       {"inf", "-inf", "nan", "1e308", "-1e308", "0x10", "1e", "+-1", "--1", "1 m"}) {
    auto const text = fmt::format("GPUShading:Geometry,G,a.obj,m,Z,{};", value);
    EXPECT_THAT(refusal(text), HasSubstr("GPUShading:Geometry G: X is ")) << value;
  }
  EXPECT_EQ(refusal("GPUShading:Geometry,G,a.obj,m,Z,+1.5E1;"), "accepted");
}

TEST(Extensions, EpJsonOfTheWrongShapeIsRefused) {
  for (auto const& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {R"({"GPUShading:Settings": []})",
            "GPUShading:Settings: is [], expected an object of objects"},
           {R"({"GPUShading:Settings": {"s": 3}})",
            "GPUShading:Settings: is 3, expected an object with fields"},
           {R"({"GPUShading:Settings": {"s": {"resolutoin": 5}}})",
            "GPUShading:Settings: \"resolutoin\": no such field; known: resolution, "
            "update_frequency, device, error, sky_model, reflections; did you mean resolution?"},
           {R"({"GPUShading:Settings": {"s": {"resolution": "5"}}})",
            "GPUShading:Settings: Resolution is the text \"5\", expected an integer from 1 to "
            "65536"},
           {R"({"GPUShading:Settings": {"s": {"resolution": null}}})",
            "GPUShading:Settings: Resolution is null, expected an integer from 1 to 65536"},
           {R"({"GPUShading:Settings": {"s": {"resolution": [5]}}})",
            "GPUShading:Settings: Resolution is [5], expected an integer from 1 to 65536"},
           {R"({"GPUShading:Settings": {"s": {"resolution": 2.5}}})",
            "GPUShading:Settings: Resolution is \"2.5\", expected an integer from 1 to 65536"},
           {R"({"GPUShading:Settings": {"a": {}, "b": {}}})",
            "GPUShading:Settings: given twice, expected once at most"},
           {R"({"GPUShading:Geometry": {" ": {"file_name": "a.obj"}}})",
            "GPUShading:Geometry  : Name is blank, expected text"},
           {R"({"GPUShading:Geometry": {"G": {"file_name": 5}}})",
            "GPUShading:Geometry G: File Name is 5, expected text"},
           {R"({"GPUShading:Geometry": {"G": {"file_name": "a.obj", "name": "G"}}})",
            "GPUShading:Geometry G: \"name\": no such field"},
           {R"({"GPUShading:Geometry": {"G": {"file_name": "a.obj", "left_out": "x"}}})",
            "GPUShading:Geometry G: left_out is the text \"x\", expected an array of objects with "
            "left_out_name"},
           {R"({"GPUShading:Geometry": {"G": {"file_name": "a.obj", "left_out": ["x"]}}})",
            "GPUShading:Geometry G: left_out[0] is the text \"x\", expected an object with "
            "left_out_name"},
           {R"({"GPUShading:Nonsense": {"a": {}}})", "GPUShading:Nonsense: no such object;"},
           {R"({"GPUShading:Settings": )", "is not valid JSON: parse error at line 1"},
       }) {
    EXPECT_THAT(epjson_refusal(text), testing::StartsWith(message)) << text;
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus
