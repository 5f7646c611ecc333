// A side file is read as a whole, or refused: none of its objects is dropped in silence.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "gpu_shading/error.h"
#include "model/idf/extension_objects.h"
#include "model/idf/model_file.h"
#include "platform/process.h"

namespace gpu_shading::energyplus {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string const shade = "GPUShading:TransparentShade,Glass,pane *,Constant,0.5;\n";
std::string const settings = "GPUShading:Settings,64;\n";

class SideFile : public ::testing::Test {
 protected:
  std::vector<InputObject> read(std::string const& text, std::string const& name = "a.idf") {
    path_ = folder_.path() / name;
    std::ofstream(path_, std::ios::binary) << text;
    return read_side_file(path_);
  }

  std::string refusal(std::string const& text, std::string const& name = "a.idf") {
    try {
      read(text, name);
    } catch (Error const& error) {
      std::string message = error.what();
      EXPECT_THAT(message, StartsWith(path_.string() + ": "));
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message;
    }
    return "none";
  }

  TemporaryFolder const folder_;
  std::filesystem::path path_;
};

std::string replaced(std::string text, std::string const& from, std::string const& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

TEST_F(SideFile, EncodingsAndLineEndsOfEveryKind) {
  auto const text = "! comment, with; separators\nVersion,9.6;\n" + shade + "! more\n" + settings;
  for (auto const& written :
       {text, "\xEF\xBB\xBF" + text, replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"),
        "\xEF\xBB\xBF" + replaced(text, "\n", "\r")}) {
    auto const objects = read(written);
    ASSERT_EQ(objects.size(), 2U);
    EXPECT_EQ(objects[0].name, "Glass");
    EXPECT_EQ(objects[0]["surface_name"], "pane *");
    EXPECT_EQ(objects[1].type, "GPUShading:Settings");
  }
  EXPECT_TRUE(read("! nothing but a comment").empty());
}

TEST_F(SideFile, TextThatIsNotUtf8) {
  std::string utf16 = "\xFF\xFE";
  for (char const letter : shade) utf16 += {letter, '\0'};
  EXPECT_THAT(refusal(utf16), HasSubstr("UTF-16"));
  EXPECT_THAT(refusal(utf16.substr(2)), HasSubstr("UTF-16"));
  EXPECT_THAT(refusal("\xFE\xFF" + shade), HasSubstr("UTF-16"));
}

TEST_F(SideFile, ObjectWithoutItsSemicolon) {
  auto const open = replaced(shade, ";", "");
  EXPECT_THAT(refusal(open), EndsWith("GPUShading:TransparentShade Glass: is not ended by ;"));
  EXPECT_THAT(refusal(settings + open + " ! comment"), HasSubstr("Glass: is not ended by ;"));
  EXPECT_THAT(refusal(open + settings), HasSubstr("Glass: is not ended by ;"));
}

TEST_F(SideFile, AnythingElse) {
  EXPECT_THAT(refusal(replaced(shade, "GPUShading:", "GPUShading :")),
              HasSubstr("GPUShading :TransparentShade: only GPUShading:... objects"));
  EXPECT_THAT(refusal(replaced(shade, "GPUShading:", "GPUShadng:")), HasSubstr("GPUShadng:"));
  EXPECT_THAT(refusal("Zone,Core;\n" + shade), HasSubstr("Zone: only GPUShading:..."));
  EXPECT_THAT(refusal("hello"), HasSubstr("hello: only"));
  EXPECT_THAT(refusal("line 1\nline 2\x1b[2J;\n" + shade),
              HasSubstr("line 1\\nline 2\\x1b[2J: only"));
  EXPECT_THAT(refusal(std::string(10'000, 'x') + ";"), HasSubstr("x...: only"));
  EXPECT_THAT(refusal("GPUShading:Glass,a;"), HasSubstr("GPUShading:Glass: no such object"));
}

TEST_F(SideFile, OtherThanFiles) {
  auto const message_of = [&](std::filesystem::path const& path) -> std::string {
    try {
      read_side_file(path);
    } catch (Error const& error) {
      return error.what();
    }
    return "none";
  };
  auto const link = folder_.path() / "link.idf";
  std::filesystem::create_symlink("nowhere.idf", link);
  EXPECT_THAT(message_of(link), EndsWith("link.idf: is a link to a file that does not exist"));
  auto const pipe = folder_.path() / "pipe.idf";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(message_of(pipe), EndsWith("pipe.idf: is not a file"));
}

TEST_F(SideFile, EpJson) {
  std::string const good = R"({"GPUShading:Settings": {"S 1": {"resolution": 64}},
      "GPUShading:Geometry": {"Sail": {"file_name": "sail.obj"}}})";
  EXPECT_EQ(read(good, "a.epJSON").size(), 2U);
  EXPECT_EQ(read("\xEF\xBB\xBF" + good, "a.epJSON").size(), 2U);
  EXPECT_THAT(refusal("[]", "a.epJSON"), HasSubstr("expected an object"));
  EXPECT_THAT(refusal(R"({"Zone": {}})", "a.epJSON"), HasSubstr("Zone: only"));
  EXPECT_THAT(refusal("{", "a.epJSON"), HasSubstr("is not valid JSON: parse error"));
  EXPECT_THAT(refusal("GPUShading:Settings;", "a.epJSON"),
              HasSubstr("is not JSON: an IDF needs the ending .idf"));
  EXPECT_THAT(refusal(good, "a.idf"), HasSubstr("is JSON: epJSON needs the ending .epJSON"));
}

std::string epjson_refusal(std::string const& text) {
  try {
    read_epjson(parse_epjson(text));
  } catch (Error const& error) {
    return error.what();
  }
  return "none";
}

TEST(EpJson, RepeatedKeysOfOurs) {
  EXPECT_THAT(epjson_refusal(R"({"GPUShading:Settings": {"S": {}}, "GPUShading:Settings": {}})"),
              HasSubstr("\"GPUShading:Settings\" is given twice"));
  EXPECT_THAT(epjson_refusal(R"({"GPUShading:Settings": {"S": {}, "S": {}}})"),
              HasSubstr("GPUShading:Settings: \"S\" is given twice"));
  EXPECT_THAT(
      epjson_refusal(R"({"GPUShading:Settings": {"S": {"resolution": 1, "resolution": 2}}})"),
      HasSubstr("\"resolution\" is given twice"));
  // The same field of two objects, EnergyPlus's own objects.
  EXPECT_EQ(epjson_refusal(R"({"GPUShading:Geometry": {
      "A": {"file_name": "a.obj"}, "B": {"file_name": "b.obj"}}})"),
            "none");
  EXPECT_EQ(epjson_refusal(R"({"Zone": {"A": {}, "A": {}}, "Zone": {}})"), "none");
}

TEST(RewriteIdf, WhatIsAddedDoesNotBecomePartOfAnOpenObject) {
  for (std::string const end : {"Zone,Core", "Zone,Core ! comment", "Zone,\n  Core\n"}) {
    auto const model = "Version,9.6;\n" + end;
    auto const text =
        rewrite_idf(model, parse_idf(model), {shading_method("PixelCounting", "Timestep")});
    auto const objects = parse_idf(text);
    ASSERT_EQ(objects.size(), 3U) << text;
    EXPECT_EQ(objects[1].fields, (std::vector<std::string>{"Core"}));
    EXPECT_EQ(objects[2].type, "ShadowCalculation");
  }
  std::string const open = "Version,9.6;\nGPUShading:Settings,64";
  auto const text = rewrite_idf(open, parse_idf(open), {shading_method("PixelCounting")});
  EXPECT_EQ(parse_idf(text).size(), 2U);
  EXPECT_EQ(text.find("\n;\n"), std::string::npos);
}

}  // namespace
}  // namespace gpu_shading::energyplus
