#include "model/options/options.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/options/option_table.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Choices take(std::vector<std::string> arguments) { return take_flags(arguments); }

// The one-line message of a refused command line.
std::string refusal(std::vector<std::string> const& arguments) {
  return refusal_of([&] { take(arguments); });
}

TEST(Options, OurFlagsAreTakenAndEnergyPlusKeepsItsOwn) {
  std::vector<std::string> arguments{"-w",
                                     "a.epw",
                                     "--gpu-shading",
                                     "--gpu-shading-update",
                                     "timestep",
                                     "--gpu-shading-device=3",
                                     "model.idf"};
  auto const choices = take_flags(arguments);
  EXPECT_EQ(arguments, (std::vector<std::string>{"-w", "a.epw", "model.idf"}));
  EXPECT_EQ(choices.mode, Mode::automatic);
  EXPECT_EQ(choices.update, (Update{true}));
  ASSERT_TRUE(choices.device);
  EXPECT_EQ(choices.device->device, numbered_device(3));
}

TEST(Options, OnAndOffInOtherWords) {
  for (auto const* const on : {"on", "Yes", "true", "1", "auto"}) {
    EXPECT_EQ(take({fmt::format("--gpu-shading={}", on)}).mode, Mode::automatic) << on;
  }
  for (auto const* const off : {"off", "No", "false", "0"}) {
    EXPECT_EQ(take({fmt::format("--gpu-shading={}", off)}).mode, Mode::off) << off;
  }
}

TEST(Options, QuietNeedsNoValueAndThreadsDo) {
  std::vector<std::string> arguments{"--gpu-shading-quiet", "--gpu-shading-threads", "3",
                                     "model.idf"};
  auto const choices = take_flags(arguments);
  EXPECT_EQ(arguments, (std::vector<std::string>{"model.idf"}));
  EXPECT_EQ(choices.quiet, true);
  EXPECT_EQ(choices.threads, 3);
  EXPECT_EQ(take({"--gpu-shading-quiet=off"}).quiet, false);
  EXPECT_EQ(take(to_flags(choices)).threads, 3);
  EXPECT_EQ(take(to_flags(choices)).quiet, true);
  for (auto const* const bad : {"0", "-1", "1.5", "many", ""}) {
    EXPECT_THAT(refusal({fmt::format("--gpu-shading-threads={}", bad)}),
                HasSubstr("expected an integer from 1 to 4096"));
  }
}

TEST(Options, MistypedFlagIsRefusedWithTheNearOne) {
  EXPECT_THAT(refusal({"--gpu-shading-devcie=cpu"}),
              HasSubstr("did you mean --gpu-shading-device?"));
  EXPECT_THAT(refusal({"--gpu-shadng"}), HasSubstr("did you mean --gpu-shading?"));
  EXPECT_THAT(refusal({"--gpushading=off"}), HasSubstr("did you mean --gpu-shading?"));
  EXPECT_THAT(refusal({"--gpu-shading-colours"}), HasSubstr("see energyplus --gpu-shading --help"));
}

TEST(Options, BareFlagDoesNotSwallowTheModel) {
  std::vector<std::string> arguments{"--gpu-shading", "off"};
  EXPECT_EQ(take_flags(arguments).mode, Mode::automatic);
  EXPECT_EQ(arguments, (std::vector<std::string>{"off"}));
}

TEST(Options, BadValuesAreNamedWithWhatWasExpected) {
  EXPECT_THAT(refusal({"--gpu-shading=maybe"}), HasSubstr("expected auto, require or off"));
  EXPECT_THAT(refusal({"--gpu-shading-resolution", "0"}), HasSubstr("is \"0\""));
  EXPECT_THAT(refusal({"--gpu-shading-resolution=12x"}), HasSubstr("is \"12x\""));
  EXPECT_THAT(refusal({"--gpu-shading-resolution"}), HasSubstr("missing"));
  EXPECT_THAT(refusal({"--gpu-shading-update=hourly"}),
              HasSubstr("expected idf, timestep, sampled:fine,"));
  EXPECT_THAT(refusal({"--gpu-shading-device=-1"}), HasSubstr("--gpu-shading-device"));
  EXPECT_THAT(refusal({"--gpu-shading-colour=red"}), HasSubstr("no such flag"));
}

TEST(Options, SamplingIsNamed) {
  auto const fine = take({"--gpu-shading-update", "sampled:Fine"}).update;
  ASSERT_TRUE(fine);
  EXPECT_TRUE(fine->every_timestep);
  EXPECT_EQ(fine->sampling, (Sampling{Sampling::Density::fine, false}));
  for (auto const* const name : {"idf", "timestep", "sampled:medium", "sampled:coarse"}) {
    auto const flag = fmt::format("--gpu-shading-update={}", name);
    EXPECT_THAT(to_flags(take({flag})), ElementsAre(flag));
  }
  EXPECT_THAT(refusal({"--gpu-shading-update=sampled"}), HasSubstr("is \"sampled\""));
  EXPECT_THAT(refusal({"--gpu-shading-update=sampled:better"}), HasSubstr("or sampled:coarse"));
  EXPECT_THAT(refusal({"--gpu-shading-update=sampled:paper-medium"}), HasSubstr("expected idf"));
}

// Every row stores its value somewhere of its own, and finds it again.
TEST(Options, RowsAreWrittenAsTheyAreRead) {
  std::vector<std::string> all;
  for (auto const& row : option_rows()) {
    auto const value = row.value.words.empty() ? "/some/path" : std::string(row.value.words.back());
    auto const number = row.value.kind == FieldKind::integer ? "7" : "0.01";
    bool const is_number =
        row.value.kind == FieldKind::integer || row.value.kind == FieldKind::real;
    auto const flag = fmt::format("{}={}", row.flag(), is_number ? number : value);
    auto const choices = take({flag});
    EXPECT_THAT(to_flags(choices), ElementsAre(flag));
    EXPECT_EQ(choices.any(), row.audience <= Audience::experts) << flag;
    Choices filled;
    filled.fill_from(choices);
    EXPECT_THAT(to_flags(filled), ElementsAre(flag));
    if (auto const variable = row.variable(); !variable.empty()) {
      setenv(variable.c_str(), flag.substr(flag.find('=') + 1).c_str(), 1);
      EXPECT_THAT(to_flags(read_environment()), ElementsAre(flag));
      unsetenv(variable.c_str());
    }
  }
}

TEST(Options, FlagsAreWrittenAsTheyAreRead) {
  // A line break in a name is part of it.
  std::vector<std::string> const flags{
      "--gpu-shading=require",         "--gpu-shading-resolution=1024",
      "--gpu-shading-update=timestep", "--gpu-shading-device=cpu",
      "--gpu-shading-file=/a b/c.idf", "--gpu-shading-report=/r\n--gpu-shading=off",
      "--gpu-shading-cache=/c",        "--gpu-shading-assets=any"};
  EXPECT_EQ(to_flags(take(flags)), flags);
  EXPECT_THAT(refusal({"--gpu-shading-device=software"}), HasSubstr("expected auto, cpu or"));
  EXPECT_THAT(to_flags(take({"--gpu-shading-cache=off"})), ElementsAre("--gpu-shading-cache=off"));
}

// Command line, environment, GPUShading:Settings, Pixel Counting Resolution, built in: each source
// is taken away in turn.
TEST(Options, Precedence) {
  auto const resolution = [](bool flag, bool environment, bool settings, bool model) {
    Choices choices;
    if (flag) choices = take({"--gpu-shading-resolution=1"});
    if (environment) setenv("GPU_SHADING_RESOLUTION", "2", 1);
    choices.fill_from(read_environment());
    unsetenv("GPU_SHADING_RESOLUTION");
    ShadingInput input;
    if (model) input.pixel_counting_resolution = 4;
    return resolve(choices,
                   settings ? read_settings(read_idf("GPUShading:Settings,3;")) : Choices{}, input)
        .resolution;
  };
  EXPECT_EQ(resolution(true, true, true, true), 1);
  EXPECT_EQ(resolution(false, true, true, true), 2);
  EXPECT_EQ(resolution(false, false, true, true), 3);
  EXPECT_EQ(resolution(false, false, false, true), 4);
  EXPECT_EQ(resolution(false, false, false, false), std::nullopt);
}

// Resolution and error answer the same question: whoever is asked first decides.
TEST(Options, AnErrorComesBeforeResolutionsOfLowerRank) {
  auto const by_flag = resolve(take({"--gpu-shading-error=0.01"}),
                               read_settings(read_idf("GPUShading:Settings,300;")), {});
  EXPECT_EQ(by_flag.resolution, std::nullopt);
  EXPECT_EQ(by_flag.error, 0.01);
  ShadingInput input;
  input.pixel_counting_resolution = 512;
  auto const by_settings =
      resolve({}, read_settings(read_idf("GPUShading:Settings,,,,0.002;")), input);
  EXPECT_EQ(by_settings.resolution, std::nullopt);
  EXPECT_EQ(by_settings.error, 0.002);
  EXPECT_EQ(resolve(take({"--gpu-shading-resolution=64"}), {}, input).resolution, 64);
  EXPECT_THAT(to_flags(take({"--gpu-shading-error=0.002"})),
              ElementsAre("--gpu-shading-error=0.002"));
}

TEST(Options, ResolutionAndErrorTogetherAreRefused) {
  EXPECT_THAT(refusal({"--gpu-shading-resolution=64", "--gpu-shading-error=0.01"}),
              AllOf(HasSubstr("--gpu-shading-resolution"), HasSubstr("--gpu-shading-error")));
  EXPECT_THROW(read_settings(read_idf("GPUShading:Settings,64,,,0.002;")), Error);
  for (auto const* const value : {"0", "0.2", "1e-6", "-0.001", "small", "nan", "0.001x"}) {
    EXPECT_THAT(refusal({std::string("--gpu-shading-error=") + value}), HasSubstr(value));
  }
}

TEST(Options, CacheHasASizeAndMayBeReadOnly) {
  auto const cache = [](std::vector<std::string> flags) {
    flags.emplace_back("--gpu-shading-cache=/f");
    return resolve(take(flags), {}, {}).cache.value();
  };
  auto const bounded = cache({"--gpu-shading-cache-size=2.5", "--gpu-shading-cache-read-only"});
  EXPECT_EQ(bounded.max_bytes, 5U << 29U);
  EXPECT_TRUE(bounded.read_only);
  EXPECT_EQ(cache({}).max_bytes, 1U << 30U);
  EXPECT_FALSE(cache({}).read_only);
  EXPECT_THAT(refusal({"--gpu-shading-cache-size=0"}), HasSubstr("cache-size"));
}

TEST(Options, CacheIsOffUnlessAFolderIsNamedAndOffOverridesTheEnvironment) {
  auto const cache = [](std::vector<std::string> const& flags, char const* environment) {
    setenv("GPU_SHADING_CACHE", environment, 1);
    auto choices = take(flags);
    choices.fill_from(read_environment());
    unsetenv("GPU_SHADING_CACHE");
    auto const resolved = resolve(choices, {}, {}).cache;
    return resolved ? std::optional(resolved->path) : std::nullopt;
  };
  EXPECT_EQ(cache({}, ""), std::nullopt);
  EXPECT_EQ(cache({}, "/e"), "/e");
  EXPECT_EQ(cache({"--gpu-shading-cache=/f"}, "/e"), "/f");
  EXPECT_EQ(cache({"--gpu-shading-cache=Off"}, "/e"), std::nullopt);
  EXPECT_EQ(cache({"--gpu-shading-cache", "here"}, "/e"), std::filesystem::absolute("here"));
  EXPECT_THAT(refusal({"--gpu-shading-cache="}), HasSubstr("expected a folder or off"));
}

TEST(Options, SettingsNameTheirField) {
  EXPECT_EQ(refusal_of([] { read_settings(read_idf("GPUShading:Settings,,hourly;")); }),
            "GPUShading:Settings: Update Frequency is \"hourly\", expected idf, timestep, "
            "sampled:fine, sampled:medium or sampled:coarse");
  auto objects = read_idf("GPUShading:Settings,64,,,0.002;");
  objects[0].file = "model.idf";
  EXPECT_EQ(refusal_of([&] { read_settings(objects); }),
            "model.idf: GPUShading:Settings: Resolution and Error are both given, expected one of "
            "them");
}

}  // namespace
}  // namespace gpu_shading::energyplus
