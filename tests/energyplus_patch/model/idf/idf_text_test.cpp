#include "model/idf/idf_text.h"

#include <gtest/gtest.h>

namespace gpu_shading::energyplus {
namespace {

TEST(IdfText, CommentsBlanksAndLineEndsAreNotPartOfFields) {
  auto const objects = parse_idf(
      "! header, with; separators\r\n"
      "Zone,  ! the type\r\n"
      "  Core zone ,  !- Name\r\n"
      "  0.5;  !- North\r\n"
      "Version,9.6;");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].type, "Zone");
  EXPECT_EQ(objects[0].fields, (std::vector<std::string>{"Core zone", "0.5"}));
  EXPECT_EQ(objects[1].fields, (std::vector<std::string>{"9.6"}));
}

TEST(IdfText, BlankFieldsKeepTheirPlace) {
  auto const objects = parse_idf("A,,x,,;");
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].fields, (std::vector<std::string>{"", "x", "", ""}));
}

TEST(IdfText, ObjectWithoutFields) {
  auto const objects = parse_idf("Output:SQLite;");
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].type, "Output:SQLite");
  EXPECT_TRUE(objects[0].fields.empty());
}

TEST(IdfText, CatchallOfAnExtensionIsTheExtension) {
  auto const objects = parse_idf(
      "Catchall,\n"
      "  GPUShading:TransparentShade,  !- Object Type\n"
      "  Glass,                        !- Generic Data Field 1\n"
      "  Pane;\n"
      "Catchall,Zone,Core;\n"
      "CATCHALL;");
  ASSERT_EQ(objects.size(), 3U);
  EXPECT_EQ(objects[0].type, "GPUShading:TransparentShade");
  EXPECT_EQ(objects[0].fields, (std::vector<std::string>{"Glass", "Pane"}));
  EXPECT_EQ(objects[0].begin, 0U);
  EXPECT_EQ(objects[1].type, "Catchall");
  EXPECT_EQ(objects[2].type, "CATCHALL");
}

TEST(IdfText, SpanIsTheObjectWithItsSemicolon) {
  std::string const text = "!c\n  A,\n  b;  !- rest\nC,d;";
  auto const objects = parse_idf(text);
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(text.substr(objects[0].begin, objects[0].end - objects[0].begin), "A,\n  b;");
  EXPECT_EQ(text.substr(objects[1].begin, objects[1].end - objects[1].begin), "C,d;");
}

TEST(IdfText, EndOfTextEndsTheLastObject) {
  for (std::string const text :
       {"A,b;\nC,d", "A,b;\nC,d  \n ! comment", "A,b;\nC,d ! comment; too\n"}) {
    auto const objects = parse_idf(text);
    ASSERT_EQ(objects.size(), 2U) << text;
    EXPECT_TRUE(objects[0].is_closed);
    EXPECT_FALSE(objects[1].is_closed);
    EXPECT_EQ(objects[1].fields, (std::vector<std::string>{"d"}));
    EXPECT_EQ(objects[1].end, text.size());
  }
  EXPECT_EQ(parse_idf("A,b;\n ! nothing, more").size(), 1U);
}

TEST(IdfText, WhatIsWrittenIsReadBack) {
  std::vector<std::string> const fields{"x", "", "3.5"};
  auto const objects = parse_idf(format_idf("A:B", fields));
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].type, "A:B");
  EXPECT_EQ(objects[0].fields, fields);
}

}  // namespace
}  // namespace gpu_shading::energyplus
