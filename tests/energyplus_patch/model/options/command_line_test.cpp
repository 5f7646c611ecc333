#include "model/options/command_line.h"

#include <gtest/gtest.h>

namespace gpu_shading::energyplus {
namespace {

TEST(CommandLine, ModelIsWhatIsNoOptionAndNoOptionsValue) {
  auto const line = read_command_line({"-w", "a.epw", "-r", "model.idf", "-d", "out"});
  EXPECT_EQ(line.model_at, 3U);
  EXPECT_EQ(line.weather, "a.epw");
  EXPECT_FALSE(line.annual || line.expand || line.design_days);
  EXPECT_EQ(line.model, "model.idf");
}

TEST(CommandLine, DefaultModel) {
  auto const line = read_command_line({"-D", "-x", "-a"});
  EXPECT_EQ(line.model, "in.idf");
  EXPECT_FALSE(line.model_at);
  EXPECT_TRUE(line.annual && line.expand && line.design_days);
}

TEST(CommandLine, ValuesAreTheNextWordOrFollowAnEqualsSign) {
  auto const words =
      read_command_line({"-w", "a.epw", "-d", "out", "-p", "room", "-s", "D", "model.idf"});
  auto const joined = read_command_line({"--weather=a.epw", "--output-directory=out",
                                         "--output-prefix=room", "--output-suffix=D", "model.idf"});
  for (auto const& line : {words, joined}) {
    EXPECT_EQ(line.weather, "a.epw");
    EXPECT_EQ(line.output_folder, "out");
    EXPECT_EQ(line.output_prefix, "room");
    EXPECT_EQ(line.output_suffix, "D");
    EXPECT_EQ(line.model, "model.idf");
  }
  EXPECT_EQ(read_command_line({"model.idf", "-d"}).output_folder, ".");
}

TEST(CommandLine, NoModelToCheck) {
  EXPECT_FALSE(read_command_line({"--version"}).model);
  EXPECT_FALSE(read_command_line({"-m", "model.imf"}).model);
  auto const help = read_command_line({"-h"});
  EXPECT_TRUE(help.help);
  EXPECT_FALSE(help.runs);
  EXPECT_TRUE(read_command_line({"-m", "model.imf"}).runs);
  EXPECT_FALSE(help.model);
}

}  // namespace
}  // namespace gpu_shading::energyplus
