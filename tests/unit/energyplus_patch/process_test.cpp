#include "base/process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "base/files.h"

namespace gpu_shading::energyplus {
namespace {

namespace fs = std::filesystem;

std::size_t entries(fs::path const& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// Runs an action in a process of its own, until `until` holds; then kills that process.
template <typename Action, typename Until>
void kill_once(Action const& action, Until const& until) {
  pid_t const child = fork();
  if (child == 0) {
    action();
    _exit(0);
  }
  for (int i = 0; i < 1000 && !until(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(until());
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST(Process, ReturnsHowItEnded) {
  TemporaryFolder const folder;
  auto const log = folder.path() / "log";
  EXPECT_EQ(run_process({"/bin/sh", "-c", "echo $GREETING; exit 7"}, {"GREETING=hello"}, log), 7);
  EXPECT_EQ(read_text_file(log), "hello\n");
  EXPECT_EQ(run_process({"/bin/sh", "-c", "kill -9 $$"}, {}, log), 128 + 9);
  EXPECT_THROW(run_process({"/nowhere/program"}, {}, log), Error);
  EXPECT_THROW(run_process({"/bin/true"}, {}, "/nowhere/log"), Error);
}

TEST(Process, IsKilledWithUs) {
  TemporaryFolder const folder;
  auto const file = folder.path() / "pid";
  auto const named = [&] { return fs::exists(file) && fs::file_size(file) > 1; };
  kill_once(
      [&] {
        run_process({"/bin/sh", "-c", "echo $$ >" + file.string() + "; exec sleep 1000"}, {},
                    folder.path() / "log");
      },
      named);
  auto const program = std::stoi(read_text_file(file));
  for (int i = 0; i < 500 && kill(program, 0) == 0; ++i) {
    // It may wait to be reaped, by a process that is not ours.
    std::ifstream stat("/proc/" + std::to_string(program) + "/stat");
    std::string text;
    std::getline(stat, text);
    if (text.find(") Z ") != std::string::npos) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_NE(kill(program, 0), 0);
}

TEST(TemporaryFolder, GoesWithTheNextOneWhereItsProcessIsKilled) {
  TemporaryFolder const parent;
  setenv("TMPDIR", parent.path().c_str(), 1);
  kill_once(
      [] {
        TemporaryFolder const left;
        std::ofstream(left.path() / "file") << "left";
        pause();
      },
      [&] { return entries(parent.path()) == 1; });
  EXPECT_EQ(entries(parent.path()), 1U);
  auto const users = parent.path() / "gpu_shading-0123abcd";
  fs::create_directory(users);
  std::ofstream(users / ".lock") << "mine";
  {
    TemporaryFolder const first;
    TemporaryFolder const second;
    EXPECT_TRUE(fs::exists(first.path()));
    EXPECT_TRUE(fs::is_empty(second.path()));
    EXPECT_EQ(entries(parent.path()), 3U);
  }
  EXPECT_EQ(entries(parent.path()), 1U);
  EXPECT_TRUE(fs::exists(users / ".lock"));
  unsetenv("TMPDIR");
}

}  // namespace
}  // namespace gpu_shading::energyplus
