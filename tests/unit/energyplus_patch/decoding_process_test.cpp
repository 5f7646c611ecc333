#include "assets/decoding_process.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "base/process.h"
#include "gpu_shading/error.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

class DecodingProcesses : public testing::Test {
 protected:
  DecodingProcesses() { std::ofstream(file_) << "content"; }

  // Reads two numbers below 100.
  std::vector<unsigned> ask(std::string const& operation, DecodingLimits const& limits = {}) {
    DecodingProcess decoding("misbehaving_decoder", operation, file_, Assets::restricted, limits);
    auto const first = decoding.next<std::uint32_t>(0, 99);
    auto const second = decoding.next<std::uint32_t>(0, 99);
    decoding.finish();
    return {first, second};
  }

  std::string refusal(std::string const& operation, DecodingLimits const& limits = {}) {
    return refusal_of([&] { ask(operation, limits); });
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "file";
};

TEST_F(DecodingProcesses, GiveAnswers) { EXPECT_EQ(ask("be good"), (std::vector<unsigned>{7, 8})); }

TEST_F(DecodingProcesses, ThatCrashAreErrors) {
  // The sanitizers end a program of their own accord.
  EXPECT_THAT(refusal("crash"),
              AnyOf(HasSubstr("crashed (Segmentation fault)"), HasSubstr("ended with status 1")));
  EXPECT_THAT(refusal("abort"), HasSubstr("crashed (Aborted)"));
  EXPECT_THAT(refusal("crash at the end"),
              AnyOf(HasSubstr("crashed (Segmentation fault)"), HasSubstr("ended with status 1")));
}

TEST_F(DecodingProcesses, ThatTakeTooLongAreEnded) {
  DecodingLimits limits;
  limits.seconds = 1;
  EXPECT_EQ(refusal("spin", limits), "it takes more than 1 s of processor time");
  limits.wait = std::chrono::seconds(1);
  EXPECT_EQ(refusal("sleep", limits), "it takes more than 1 s");
}

TEST_F(DecodingProcesses, ThatTakeTooMuchMemoryAreEnded) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer needs more address space than any limit";
#endif
  DecodingLimits limits;
  limits.memory = std::uint64_t{100} << 20U;
  EXPECT_EQ(refusal("fill memory", limits), "it takes more than 100 MiB of memory");
}

TEST_F(DecodingProcesses, AreNotBelieved) {
  auto const invalid = "the program that decodes it gave an invalid answer";
  for (auto const* operation :
       {"wrong mark", "wrong status", "endless reason", "too large", "say more"}) {
    EXPECT_EQ(refusal(operation), invalid) << operation;
  }
  EXPECT_EQ(refusal("say nothing"), "the program that decodes it ended with status 0");
  EXPECT_EQ(refusal("end early"), "the program that decodes it ended with status 0");
  EXPECT_EQ(refusal("reason of two lines"), "one line [2J");
}

TEST_F(DecodingProcesses, CanDoNothingElse) {
  std::vector<unsigned> const no{0, 8};
  EXPECT_EQ(ask("read input"), (std::vector<unsigned>{1, 8}));
  for (auto const* operation :
       {"write a file", "change the input", "remove a file", "open a socket", "start a process",
        "run a program", "signal its parent"}) {
    EXPECT_EQ(ask(operation), no) << operation;
  }
  EXPECT_EQ(ask("read another file"), no);
  EXPECT_TRUE(std::filesystem::exists(file_));
  EXPECT_FALSE(std::filesystem::exists(file_.string() + ".written"));
}

TEST_F(DecodingProcesses, ReadRegularFilesOfLimitedSize) {
  DecodingLimits limits;
  limits.file_size = 3;
  EXPECT_THAT(refusal("be good", limits), HasSubstr("is larger than"));
  auto const pipe = folder_.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR), 0);
  file_ = pipe;
  EXPECT_EQ(refusal("be good"), "is not a file");
}

TEST_F(DecodingProcesses, AreNamedIfTheyAreMissing) {
  EXPECT_THAT(refusal_of([&] { DecodingProcess("no_decoder", "read", file_, Assets::restricted); }),
              HasSubstr("no_decoder: No such file or directory"));
}

// The number of processes whose parent is a process.
int children_of(pid_t parent) {
  int children = 0;
  for (auto const& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream status(entry.path() / "status");
    for (std::string line; std::getline(status, line);) {
      if (line == "PPid:\t" + std::to_string(parent)) ++children;
    }
  }
  return children;
}

TEST_F(DecodingProcesses, EndWithTheProgramThatStartedThem) {
  auto const child = fork();
  if (child == 0) {
    refusal("sleep");
    _exit(0);
  }
  auto const wait_for = [&](auto const& condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return condition();
  };
  ASSERT_TRUE(wait_for([&] { return children_of(child) == 1; }));
  pid_t decoder = 0;
  std::ifstream("/proc/" + std::to_string(child) + "/task/" + std::to_string(child) +
                "/children") >>
      decoder;
  ASSERT_GT(decoder, 0);
  // Once it has asked for that.
  auto const name = "/proc/" + std::to_string(decoder) + "/status";
  ASSERT_TRUE(wait_for([&] {
    std::ifstream status(name);
    for (std::string line; std::getline(status, line);) {
      if (line == "Seccomp:\t2") return true;
    }
    return false;
  }));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(wait_for([&] { return kill(decoder, 0) != 0; }));
}

}  // namespace
}  // namespace gpu_shading::energyplus
