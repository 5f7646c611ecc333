#include "platform/instructions.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "gpu_shading/perforated_screen.h"
#include "support/crowds.h"
#include "support/random_scene.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

// Run by the test below in processes of its own, since a process keeps to one set.
TEST(Instructions, DISABLED_PrintAnswers) {
  HolePattern const holes({.hole = Hole::Hexagonal, .size = 0.2, .pitch = 0.3});
  auto const mesh = std::make_shared<PerforatedScreen const>(holes, Sheet{.thickness = 0.02});
  std::printf("%s\n", describe(cpu_device()).c_str());
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    RandomScene const random = random_scene(seed);
    Scene scene;
    for (SurfaceId id = 0; id < random.scene.size(); ++id) {
      Surface surface = random.scene[id];
      if (seed % 2 == 0 && id % 2 == 1) surface.filter.set(PerforatedSheet{mesh});
      scene.add(surface);
    }
    if (seed % 3 == 0) {
      auto const place = random.scene[0].polygon.outline[0] + 3.0 * to_vector(random.sun);
      Surface crown{"crown", level(place.x - 1.0, place.y - 1.0, place.z - 1.0, 2.0, 2.0)};
      crown.filter.set(Crown{.height = 2.0});
      scene.add(crown);
    }
    Renderer renderer = renderer_of(scene, 300, on_cpu);
    std::printf("answer %a\n", sunlit(renderer, random.sun, 0).projected_area);
  }
  RendererOptions options;
  options.device = on_cpu;
  options.error = 1e-2;
  for (Scene const& crowd : {mixed_crowd(5000), fine_louvres(3000, 0.5)}) {
    Renderer renderer(crowd, options);
    for (int i = 0; i < 10; ++i) {
      SunDirection const sun = sun_at(110 + 14 * i, 5 + 5 * i);
      std::printf("answer %a\n", sunlit(renderer, sun, 0).projected_area);
    }
  }
}

std::string answers_with(std::string const& set) {
  std::string const program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::string const command = "GPU_SHADING_INSTRUCTIONS=" + set + " '" + program +
                              "' --gtest_also_run_disabled_tests"
                              " --gtest_filter=Instructions.DISABLED_PrintAnswers 2>&1";
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::string text;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) {
    text += static_cast<char>(letter);
  }
  pclose(pipe);
  return text;
}

std::string numbers_in(std::string const& text) {
  return text.substr(text.find("answer"), text.rfind("answer") - text.find("answer"));
}

TEST(Instructions, AllSetsGiveTheSameAnswersToTheBit) {
  std::string const baseline = answers_with("baseline");
  ASSERT_NE(baseline.find("baseline instructions)"), std::string::npos) << baseline;
  ASSERT_NE(baseline.find("answer 0x1"), std::string::npos) << baseline;
  for (std::string const set : {"sse4", "avx2", ""}) {
    EXPECT_EQ(numbers_in(answers_with(set)), numbers_in(baseline)) << set;
  }
}

TEST(Instructions, AnUnknownSetIsRefused) {
  EXPECT_NE(answers_with("avx3").find(
                "GPU_SHADING_INSTRUCTIONS is 'avx3': expected 'baseline', 'sse4' or 'avx2'"),
            std::string::npos);
}

}  // namespace
}  // namespace gpu_shading
