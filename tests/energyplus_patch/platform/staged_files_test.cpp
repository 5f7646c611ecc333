// What is written is there as a whole, or what was there before is.

#include "platform/staged_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/process.h"

namespace gpu_shading::energyplus {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

std::vector<std::string> names_in(fs::path const& folder) {
  std::vector<std::string> names;
  for (auto const& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

void put(fs::path const& path, std::string const& text) { std::ofstream(path) << text; }

std::string text_of(fs::path const& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <typename Action>
std::string error_of(Action const& action) {
  try {
    action();
  } catch (Error const& error) {
    return error.what();
  }
  return "none";
}

TEST(StagedFiles, AreThereOnceTheyAreCommitted) {
  TemporaryFolder const folder;
  auto const below = folder.path() / "made" / "for it";
  {
    StagedFiles files(below);
    files.write("a.csv", [](std::ostream& out) { out << "1,2\n"; });
    files.write("b.png", std::string_view("\0x", 2));
    put(folder.path() / "drawn", "picture");
    files.copy("c", folder.path() / "drawn");
    auto const staged = files.add("d");
    fs::create_directory(staged);
    put(staged / "e", "below");
    EXPECT_EQ(names_in(below).size(), 1U);
    files.commit();
  }
  EXPECT_THAT(names_in(below), UnorderedElementsAre("a.csv", "b.png", "c", "d"));
  EXPECT_EQ(text_of(below / "a.csv"), "1,2\n");
  EXPECT_EQ(text_of(below / "b.png"), std::string("\0x", 2));
  EXPECT_EQ(text_of(below / "c"), "picture");
  EXPECT_EQ(text_of(below / "d" / "e"), "below");
}

TEST(StagedFiles, AreNotThereOtherwise) {
  TemporaryFolder const folder;
  put(folder.path() / "a", "old");
  { StagedFiles(folder.path()).write("a", "new"); }
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a"));
  EXPECT_EQ(text_of(folder.path() / "a"), "old");
}

TEST(StagedFiles, ReplaceFilesOnly) {
  TemporaryFolder const folder;
  auto const path = [&](char const* name) { return folder.path() / name; };
  put(path("users"), "mine");
  fs::create_symlink("users", path("link"));
  fs::create_symlink("nowhere", path("dangling"));
  fs::create_directory(path("folder"));
  put(path("folder") / "file", "mine");
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  for (auto const& [name, why] : {std::pair("link", "it is a link"),
                                  {"dangling", "it is a link"},
                                  {"folder", "it is a folder"},
                                  {"pipe", "it is not a file"},
                                  {"..", "it is not the name of a file"},
                                  {"a/b", "it is not the name of a file"}}) {
    EXPECT_THAT(error_of([&, file = name] { StagedFiles(folder.path()).write(file, "new"); }),
                HasSubstr(why));
    // A link that comes after the first look.
    if (std::string(name) == "link") {
      StagedFiles files(folder.path());
      files.write("late", "new");
      fs::create_symlink("users", path("late"));
      EXPECT_THAT(error_of([&] { files.commit(); }), HasSubstr("it is a link"));
      fs::remove(path("late"));
    }
  }
  EXPECT_THAT(error_of([] { write_whole_file("/dev/null", [](std::ostream&) {}); }),
              HasSubstr("it is not a file"));
  EXPECT_EQ(text_of(path("users")), "mine");
  EXPECT_THAT(names_in(folder.path()),
              UnorderedElementsAre("users", "link", "dangling", "folder", "pipe"));
}

TEST(StagedFiles, RefuseTheSameNameTwice) {
  TemporaryFolder const folder;
  StagedFiles files(folder.path());
  files.write("a", "1");
  EXPECT_THAT(error_of([&] { files.write("a", "2"); }), HasSubstr("written twice"));
}

TEST(StagedFiles, FailedWriteLeavesAllFilesAsTheyWere) {
  TemporaryFolder const folder;
  put(folder.path() / "small", "old");
  put(folder.path() / "large", "old");
  // As a full disk would, but for the name of the trouble.
  auto* const before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  rlimit const small{4096, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  auto const message = error_of([&] {
    StagedFiles files(folder.path());
    files.write("small", "new");
    files.write("large", std::string(100'000, 'x'));
    files.commit();
  });
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(message, (folder.path() / "large").string() + ": cannot be written (File too large)");
  EXPECT_THAT(names_in(folder.path()), UnorderedElementsAre("small", "large"));
  EXPECT_EQ(text_of(folder.path() / "small"), "old");
  EXPECT_EQ(text_of(folder.path() / "large"), "old");
}

// Runs an action in a process that is killed where the action ends.
template <typename Action>
void kill_after(Action const& action) {
  pid_t const child = fork();
  if (child == 0) {
    action();
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

TEST(StagedFiles, WhatAKilledProcessHasLeftIsDeleted) {
  TemporaryFolder const folder;
  put(folder.path() / "a", "old");
  kill_after([&] {
    auto* const files = new StagedFiles(folder.path());  // not destroyed
    files->write("a", "ne");
  });
  EXPECT_EQ(text_of(folder.path() / "a"), "old");
  EXPECT_EQ(names_in(folder.path()).size(), 2U);
  StagedFiles files(folder.path());
  files.write("a", "new");
  files.commit();
  EXPECT_EQ(text_of(folder.path() / "a"), "new");
  EXPECT_EQ(names_in(folder.path()).size(), 2U);  // this object's own
}

TEST(StagedFiles, WhatIsInUseOrNotOursIsNotDeleted) {
  TemporaryFolder const folder;
  auto const name = std::string(StagedFiles::prefix) + "12345678";
  fs::create_directory(folder.path() / name);
  put(folder.path() / name / "mine", "mine");
  fs::create_directory_symlink(name, folder.path() / (std::string(StagedFiles::prefix) + "link"));
  StagedFiles first(folder.path());
  first.write("a", "first");
  StagedFiles second(folder.path());
  second.write("a", "second");
  second.commit();
  EXPECT_EQ(text_of(folder.path() / "a"), "second");
  first.commit();
  EXPECT_EQ(text_of(folder.path() / "a"), "first");
  EXPECT_EQ(text_of(folder.path() / name / "mine"), "mine");
}

TEST(StagedFiles, ManyAtTheSameTime) {
  TemporaryFolder const folder;
  constexpr int count = 8;
  std::vector<std::thread> threads;
  threads.reserve(count);
  for (int thread = 0; thread < count; ++thread) {
    threads.emplace_back([&folder, thread] {
      for (int i = 0; i < 50; ++i) {
        StagedFiles files(folder.path());
        files.write("a", std::string(10'000, static_cast<char>('a' + thread)));
        files.commit();
      }
    });
  }
  for (auto& thread : threads) thread.join();
  auto const text = text_of(folder.path() / "a");
  EXPECT_EQ(text, std::string(10'000, text.front()));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
