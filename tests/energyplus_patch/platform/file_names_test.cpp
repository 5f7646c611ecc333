// Surfaces may have any name; their pictures need names of files that do not meet.

#include <gtest/gtest.h>

#include "platform/files.h"

namespace gpu_shading::energyplus {
namespace {

TEST(FileNames, TextKeepsItsLettersAndDigits) {
  FileNames names;
  EXPECT_EQ(names.add("WEST-Window 3.2", ".png"), "WEST-Window_3.2.png");
  EXPECT_EQ(names.add("a/b\\c:d\te\n", ".png"), "a_b_c_d_e_.png");
  EXPECT_EQ(names.add("..", ".png"), "_..png");
  EXPECT_EQ(names.add(".hidden", ".png"), "_hidden.png");
  EXPECT_EQ(names.add("", ".png"), ".png");
}

TEST(FileNames, LettersOfEveryScriptAreKept) {
  FileNames names;
  EXPECT_EQ(names.add("Süd-Fenster Ø", ".png"), "Süd-Fenster_Ø.png");
  EXPECT_EQ(names.add("南の窓", ".png"), "南の窓.png");
  EXPECT_EQ(names.add("\xF0\x9D\x94\xB8", ".png"), "\xF0\x9D\x94\xB8.png");
}

TEST(FileNames, WhatMisleadsIsReplaced) {
  FileNames names;
  // Right-to-left override, zero width space, no-break space, next line.
  EXPECT_EQ(names.add("a\u202Egpj.b", ""), "a_gpj.b");
  EXPECT_EQ(names.add("a\u200Bb\u00A0c\u0085d", ""), "a_b_c_d");
  // Latin-1, a cut sequence, an overlong one, a surrogate.
  EXPECT_EQ(names.add("S\xFC"
                      "d",
                      ""),
            "S_d");
  EXPECT_EQ(names.add("x\xE5\x8D", ""), "x__");
  EXPECT_EQ(names.add("y\xC0\xAF", ""), "y__");
  EXPECT_EQ(names.add("z\xED\xA0\x80", ""), "z___");
}

TEST(FileNames, NoTwoAreTheSame) {
  FileNames names;
  EXPECT_EQ(names.add("W 1", ".png"), "W_1.png");
  EXPECT_EQ(names.add("W_1", ".png"), "W_1_2.png");
  EXPECT_EQ(names.add("W.1", ".png"), "W.1.png");
  EXPECT_EQ(names.add("W 1 2", ".png"), "W_1_2_2.png");
  EXPECT_EQ(names.add("W 1", ".png"), "W_1_3.png");
}

TEST(FileNames, LongTextIsCutBetweenCharacters) {
  FileNames names;
  std::string text;
  for (int i = 0; i < 100; ++i) text += "窓";  // three bytes each
  auto const first = names.add(text, ".png");
  EXPECT_LE(first.size(), 255U);
  EXPECT_EQ((first.size() - 4) % 3, 0U);
  EXPECT_NE(names.add(text + "b", ".png"), first);
}

}  // namespace
}  // namespace gpu_shading::energyplus
