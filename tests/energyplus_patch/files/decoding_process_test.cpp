#include "files/decoding_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "files/decoding/sandbox.h"
#include "files/unconfined_decoding.h"
#include "gpu_shading/error.h"
#include "platform/process.h"
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
  if (!decoding::limits_memory) {
    GTEST_SKIP() << "the address sanitizer needs more address space than any limit";
  }
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
        "run a program", "signal its parent", "choose who gets signals", "choose a signal",
        "ask for signals", "ask for a lease"}) {
    EXPECT_EQ(ask(operation), no) << operation;
  }
  EXPECT_EQ(ask("read another file"), no);
  EXPECT_TRUE(std::filesystem::exists(file_));
  EXPECT_FALSE(std::filesystem::exists(file_.string() + ".written"));
}

// What `action` says in a fork of this process, from which the kernel refuses calls; of prctl()
// only the one that sets a filter.
template <typename Action>
std::string said_without(std::vector<int> const& calls, int error, Action const& action) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return "no pipe";
  auto const child = fork();
  if (child == 0) {
    auto* const filter = seccomp_init(SCMP_ACT_ALLOW);
    for (auto const call : calls) {
      auto const refused = SCMP_ACT_ERRNO(static_cast<std::uint32_t>(error));
      scmp_arg_cmp const sets_filter{0, SCMP_CMP_EQ, PR_SET_SECCOMP, 0};
      seccomp_rule_add_array(filter, refused, call, call == SCMP_SYS(prctl) ? 1 : 0, &sets_filter);
    }
    auto const text = seccomp_load(filter) == 0 ? action() : "no filter";
    _exit(write(ends[1], text.data(), text.size()) < 0 ? 1 : 0);
  }
  close(ends[1]);
  std::array<char, 1000> text{};
  auto const length = read(ends[0], text.data(), text.size());
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return {text.data(), static_cast<std::size_t>(std::max<ssize_t>(0, length))};
}

TEST_F(DecodingProcesses, ThatCannotGiveUpTheirRightsDecodeNothing) {
  auto const decode = [&] { return refusal("be good"); };
  auto const start = std::string("the decoding process cannot give up its rights: ");
  EXPECT_EQ(said_without({SCMP_SYS(landlock_restrict_self)}, EPERM, decode),
            start + "landlock_restrict_self: Operation not permitted");
  EXPECT_THAT(said_without({SCMP_SYS(seccomp), SCMP_SYS(prctl)}, EINVAL, decode),
              HasSubstr(start + "seccomp"));
  // The address sanitizer itself needs to know the limits, and ends the process before.
  if (!decoding::limits_memory) return;
  EXPECT_EQ(said_without({SCMP_SYS(setrlimit), SCMP_SYS(prlimit64)}, EPERM, decode),
            start + "setrlimit: Operation not permitted");
}

TEST_F(DecodingProcesses, ReadAnyFileButChangeNoneWhereTheKernelHasNoLandlock) {
  auto const first = [&](std::string const& operation) {
    return said_without({SCMP_SYS(landlock_create_ruleset)}, ENOSYS,
                        [&] { return std::to_string(ask(operation).front()); });
  };
  EXPECT_EQ(first("be good"), "7");
  for (int const error : {ENOSYS, EPERM, EOPNOTSUPP}) {
    auto const warned = [&] {
      ask("be good");
      bool const first_time = take_unconfined_decoding();
      return fmt::format("{}, then {}", first_time, take_unconfined_decoding());
    };
    EXPECT_EQ(said_without({SCMP_SYS(landlock_create_ruleset)}, error, warned), "true, then false");
  }
  ask("be good");
  EXPECT_FALSE(take_unconfined_decoding());
  EXPECT_EQ(first("read another file"), "1");
  for (auto const* operation : {"write a file", "change the input", "remove a file",
                                "open a socket", "signal its parent", "ask for signals"}) {
    EXPECT_EQ(first(operation), "0") << operation;
  }
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

std::string status_of(pid_t process, std::string const& key) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key + ":\t")) return line.substr(key.size() + 2);
  }
  return "";
}

// The processes whose parent is a process.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  for (auto const& entry : std::filesystem::directory_iterator("/proc")) {
    auto const process = std::atoi(entry.path().filename().c_str());
    if (process > 0 && status_of(process, "PPid") == std::to_string(parent)) {
      children.push_back(process);
    }
  }
  return children;
}

template <typename Condition>
bool wait_for(Condition const& condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return condition();
}

TEST_F(DecodingProcesses, EndWithTheProgramThatStartedThem) {
  auto const child = fork();
  if (child == 0) {
    refusal("sleep");
    _exit(0);
  }
  // One that waits for requests, and one that decodes, confined by then.
  std::vector<pid_t> all;
  ASSERT_TRUE(wait_for([&] {
    all = children_of(child);
    return all.size() == 2 && std::any_of(all.begin(), all.end(), [](pid_t process) {
             return status_of(process, "Seccomp") == "2";
           });
  }));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  for (auto const process : all) {
    EXPECT_TRUE(wait_for([&] { return kill(process, 0) != 0; }));
  }
}

TEST_F(DecodingProcesses, AreStartedByOneProgramForEachThread) {
  std::vector<unsigned> const answer{7, 8};
  auto const before = children_of(getpid());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(ask("be good"), answer);
    EXPECT_THAT(refusal("abort"), HasSubstr("crashed (Aborted)"));
  }
  auto const after = children_of(getpid());
  EXPECT_LE(after.size(), before.size() + 1);
  ASSERT_FALSE(after.empty());
  std::thread([&] { EXPECT_EQ(ask("be good"), answer); }).join();
  EXPECT_EQ(children_of(getpid()), after);
  // If it has ended meanwhile, it is started again.
  for (auto const process : after) kill(process, SIGKILL);
  EXPECT_EQ(ask("be good"), answer);
  // A fork has its own, and that of this process goes on.
  auto const child = fork();
  if (child == 0) _exit(ask("be good") == answer ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(ask("be good"), answer);
}

// The one child of this process that waits for requests.
pid_t server_after(std::vector<pid_t> const& before) {
  for (auto const child : children_of(getpid())) {
    if (std::ranges::count(before, child) == 0) return child;
  }
  return -1;
}

TEST_F(DecodingProcesses, DoNotWaitForAStoppedProgram) {
  std::vector<unsigned> const answer{7, 8};
  DecodingLimits limits;
  limits.wait = std::chrono::seconds(1);
  std::thread([&] {
    auto const before = children_of(getpid());
    EXPECT_EQ(ask("be good"), answer);
    auto const stopped = server_after(before);
    ASSERT_EQ(kill(stopped, SIGSTOP), 0);
    EXPECT_EQ(refusal("be good", limits), "it takes more than 1 s");
    EXPECT_NE(kill(stopped, 0), 0);
    EXPECT_EQ(ask("be good"), answer);
    ASSERT_EQ(kill(server_after(before), SIGSTOP), 0);
    // The end of this thread ends it.
  }).join();
}

// Each of the standard descriptors, and all, closed in a fork of this process.
TEST_F(DecodingProcesses, NeedNoStandardDescriptors) {
  std::vector<unsigned> const answer{7, 8};
  for (unsigned closed = 1; closed < 8; ++closed) {
    auto const child = fork();
    if (child == 0) {
      for (int i = 0; i < 3; ++i) {
        if ((closed >> static_cast<unsigned>(i) & 1U) != 0) close(i);
      }
      _exit(refusal_of([&] {
              if (ask("be good") != answer || ask("read input").front() != 1) throw Error("wrong");
            }) == "accepted"
                ? 0
                : 1);
    }
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << closed;
  }
}

TEST_F(DecodingProcesses, FindFilesWhereTheProgramIsNow) {
  auto const before = std::filesystem::current_path();
  ask("be good");
  std::filesystem::current_path(folder_.path());
  file_ = file_.filename();
  EXPECT_EQ(ask("be good"), (std::vector<unsigned>{7, 8}));
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace gpu_shading::energyplus
