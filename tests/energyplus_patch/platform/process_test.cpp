#include "platform/process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

#include "platform/ending_signals.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {
namespace {

namespace fs = std::filesystem;

std::size_t entries(fs::path const& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// Runs an action in a process of its own, until `until` holds; then sends it a signal. Returns how
// it ended.
template <typename Action, typename Until>
int kill_once(Action const& action, Until const& until, int sent = SIGKILL) {
  pid_t const child = fork();
  if (child == 0) {
    action();
    _exit(0);
  }
  for (int i = 0; i < 1000 && !until(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(until());
  kill(child, sent);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
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

// In a process of its own, with a folder in `parent`.
class EndingSignals : public testing::TestWithParam<int> {
 public:
  EndingSignals(EndingSignals const&) = delete;
  EndingSignals& operator=(EndingSignals const&) = delete;

 protected:
  EndingSignals() { setenv("TMPDIR", parent.path().c_str(), 1); }
  ~EndingSignals() override { unsetenv("TMPDIR"); }

  static void make_deep_folder(fs::path const& folder) {
    fs::create_directories(folder / "a" / "b" / "c");
    for (auto const* const name : {"1", "a/2", "a/b/3", "a/b/c/4"})
      std::ofstream(folder / name) << name;
  }

  TemporaryFolder parent;
  fs::path ready = parent.path() / "ready";
};

TEST_P(EndingSignals, DeleteTheFolders) {
  int const ended = kill_once(
      [&] {
        signal(GetParam(), SIG_DFL);
        clean_up_at_signals();
        TemporaryFolder const first;
        TemporaryFolder const second;
        make_deep_folder(first.path());
        fs::current_path(second.path());
        std::ofstream(ready) << "ready";
        while (true) pause();
      },
      [&] { return fs::exists(ready); }, GetParam());
  EXPECT_EQ(ended, GetParam());
  EXPECT_EQ(entries(parent.path()), 1U);
}

INSTANTIATE_TEST_SUITE_P(Signals, EndingSignals,
                         testing::Values(SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM, SIGXCPU,
                                         SIGXFSZ));

// The folder may be another process's until it is made, but an empty one is of no use to it.
TEST_F(EndingSignals, DeleteFoldersThatAreBeingMadeIfTheyAreEmpty) {
  auto const in_parent = [&](char const* name) { return parent.path() / name; };
  for (auto const* const name : {"other", "empty", "own"}) fs::create_directory(in_parent(name));
  for (auto const* const name : {"other", "own"}) std::ofstream(in_parent(name) / "file") << name;
  int const ended = kill_once(
      [&] {
        clean_up_at_signals();
        FolderAtSignals const other(in_parent("other"));
        FolderAtSignals const empty(in_parent("empty"));
        FolderAtSignals own(in_parent("own"));
        own.is_made();
        std::ofstream(ready) << "ready";
        while (true) pause();
      },
      [&] { return fs::exists(ready); }, SIGTERM);
  EXPECT_EQ(ended, SIGTERM);
  EXPECT_TRUE(fs::exists(in_parent("other") / "file"));
  EXPECT_FALSE(fs::exists(in_parent("empty")));
  EXPECT_FALSE(fs::exists(in_parent("own")));
}

TEST_F(EndingSignals, EndProgramsFirst) {
  auto const log = parent.path() / "log";
  int const ended = kill_once(
      [&] {
        clean_up_at_signals();
        // This thread gets the signal, or the one that waits for the program.
        std::thread([] {
          while (true) pause();
        }).detach();
        try {
          TemporaryFolder const folder;
          auto const script = "trap 'echo ended >" + log.string() + "; exit' TERM; touch " +
                              ready.string() + "; while true; do date >>" +
                              (folder.path() / "dates").string() + "; done";
          run_process({"/bin/sh", "-c", script}, {}, parent.path() / "output");
          pause();
        } catch (Interrupted const& interrupted) {
          interrupted.raise();
        }
      },
      [&] { return fs::exists(ready); }, SIGTERM);
  EXPECT_EQ(ended, SIGTERM);
  EXPECT_EQ(read_text_file(log), "ended\n");
  EXPECT_EQ(entries(parent.path()), 3U);  // the files above, and no folder
}

TEST_F(EndingSignals, LeaveTheFoldersOfTheParentAlone) {
  kill_once(
      [&] {
        clean_up_at_signals();
        TemporaryFolder const folder;
        kill_once([] { pause(); }, [] { return true; }, SIGTERM);
        if (fs::exists(folder.path())) std::ofstream(ready) << "ready";
        while (true) pause();
      },
      [&] { return fs::exists(ready); }, SIGTERM);
}

TEST_F(EndingSignals, StayIgnoredOrHandled) {
  kill_once(
      [&] {
        signal(SIGHUP, SIG_IGN);
        signal(SIGINT, [](int) {});
        clean_up_at_signals();
        TemporaryFolder const folder;
        raise(SIGHUP);
        raise(SIGINT);
        if (fs::exists(folder.path())) std::ofstream(ready) << "ready";
        while (true) pause();
      },
      [&] { return fs::exists(ready); });
}

TEST_F(EndingSignals, AreUntouchedInAHost) {
  TemporaryFolder const folder;
  struct sigaction action {};
  ASSERT_EQ(sigaction(SIGTERM, nullptr, &action), 0);
  EXPECT_EQ(action.sa_handler, SIG_DFL);
}

TEST_F(EndingSignals, FolderGoesWithTheLastDescriptor) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  std::vector<int> taken;
  {
    TemporaryFolder const folder;
    make_deep_folder(folder.path());
    rlimit few = before;
    few.rlim_cur = 64;
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &few), 0);
    for (int next = dup(0); next >= 0; next = dup(0)) taken.push_back(next);
  }
  for (int const descriptor : taken) close(descriptor);
  setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_EQ(entries(parent.path()), 0U);
}

TEST_F(EndingSignals, FolderIsDeletedButNotWhatItLinksTo) {
  auto const folder = parent.path() / "folder";
  auto const other = parent.path() / "other";
  make_deep_folder(other);
  make_deep_folder(folder);
  fs::create_directory_symlink(other, folder / "a" / "link");
  fs::create_symlink(other / "1", folder / "file");
  EXPECT_TRUE(delete_folder(folder.c_str()));
  EXPECT_FALSE(fs::exists(folder));
  EXPECT_EQ(read_text_file(other / "a" / "b" / "c" / "4"), "a/b/c/4");
  EXPECT_TRUE(delete_folder(folder.c_str()));
  EXPECT_FALSE(delete_folder((other / "1").c_str()));
  EXPECT_TRUE(fs::exists(other / "1"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
