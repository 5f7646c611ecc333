#include "answers/disk_cache.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "answers/cache_folder.h"
#include "gpu_shading/error.h"
#include "platform/process.h"

namespace gpu_shading::energyplus {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Hash scene_of(std::uint8_t number) {
  Hash hash{};
  hash[0] = number;
  return hash;
}

Sunlit lit(double area, std::vector<ScheduledPart> scheduled = {},
           std::optional<double> error = 0.0) {
  Sunlit answer;
  answer.error = error;
  answer.projected_area = area;
  answer.scheduled = std::move(scheduled);
  return answer;
}

SunDirection const noon{0.1, 0.9};
std::vector<ScheduledPart> const parts{{{{0, 1}, {2, 3}}, 0.5}, {{}, 0.125}};

// Two receivers, two states, an interior question.
SceneAnswers some_answers() {
  SceneAnswers set;
  set.receivers = {7, 3};
  auto const all = set.states.number_of({1.0, 1.0});
  auto const half = set.states.number_of({0.5, 1.0});
  set.answers.keep(set.answers.at(noon, all), 0, lit(1.5));
  set.answers.keep(set.answers.at(noon, half), 1, lit(2.5, parts, 0.25));
  set.answers.keep_interior(set.answers.at(noon, half), 99,
                            {lit(0.75, {}, std::nullopt), lit(0.0, parts, std::nullopt)});
  return set;
}

void expect_some_answers(SceneAnswers const& set) {
  ASSERT_EQ(set.receivers, (std::vector<SurfaceId>{7, 3}));
  ASSERT_EQ(set.states.size(), 2U);
  EXPECT_EQ(set.states[1], (DeploymentStates::Shares{0.5, 1.0}));
  ASSERT_EQ(set.answers.size(), 2U);
  auto const* const all = set.answers.find(noon, 0);
  auto const* const half = set.answers.find(noon, 1);
  ASSERT_TRUE(all != nullptr && half != nullptr);
  EXPECT_EQ(all->projected_area[0], 1.5F);
  EXPECT_EQ(all->error(0), 0.0);
  EXPECT_FALSE(all->knows(1));
  EXPECT_FALSE(half->knows(0));
  EXPECT_EQ(half->area(1, std::vector<double>{0.5, 1.0, 0.5}), 2.5 + 0.5 * 0.5 * 0.125 + 0.125);
  EXPECT_EQ(half->error(1), 0.25);
  ASSERT_TRUE(half->interior.contains(99));
  auto const interior = half->sunlit(half->interior.at(99));
  ASSERT_EQ(interior.size(), 2U);
  EXPECT_EQ(interior[0].projected_area, 0.75);
  EXPECT_EQ(interior[0].error, std::nullopt);
  ASSERT_EQ(interior[1].scheduled.size(), 2U);
  EXPECT_EQ(interior[1].scheduled[0].powers, parts[0].powers);
  EXPECT_EQ(interior[1].scheduled[1].projected_area, 0.125);
}

std::vector<std::byte> read(fs::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::string const text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  auto const bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

void write(fs::path const& path, std::string const& text) { std::ofstream(path) << text; }

// A cache's file, and what is said of it.
struct Cached {
  explicit Cached(fs::path folder, std::uint8_t number = 1)
      : path(std::move(folder)), scene(scene_of(number)) {}

  DiskCache open() { return open({path}); }
  DiskCache open(std::uint64_t max_bytes) { return open({path, max_bytes}); }
  DiskCache open_read_only() { return open({.path = path, .read_only = true}); }
  DiskCache open(CacheFolder const& folder) {
    return {folder, scene, {std::vector<double>(10, 30.0), 3}, [this](std::string const& line) {
              remarks.push_back(line);
            }};
  }
  fs::path file() const { return path / cache_file_name(fmt::format("{:02x}{:030}", scene[0], 0)); }
  SceneAnswers stored() const { return decode(read(file()), scene); }

  fs::path path;
  Hash scene;
  std::vector<std::string> remarks;
};

TEST(AnswerFile, HoldsScheduledPartsInteriorsAndStates) {
  expect_some_answers(decode(encode(some_answers(), scene_of(1)), scene_of(1)));
}

TEST(AnswerFile, IsRefusedWithAnyByteDamaged) {
  auto const good = encode(some_answers(), scene_of(1));
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (auto const flip : {std::byte{1}, std::byte{0x80}, std::byte{0xff}}) {
      auto bad = good;
      bad[i] ^= flip;
      EXPECT_THROW(decode(bad, scene_of(1)), Error) << "byte " << i;
    }
  }
}

TEST(AnswerFile, IsRefusedTruncatedAnywhereOrWithMoreAtItsEnd) {
  auto bytes = encode(some_answers(), scene_of(1));
  bytes.push_back({});
  EXPECT_THROW(decode(bytes, scene_of(1)), Error);
  bytes.pop_back();
  EXPECT_NO_THROW(decode(bytes, scene_of(1)));
  while (!bytes.empty()) {
    bytes.pop_back();
    EXPECT_THROW(decode(bytes, scene_of(1)), Error) << bytes.size();
  }
}

TEST(AnswerFile, IsRefusedForAnotherScene) {
  EXPECT_THROW(decode(encode(some_answers(), scene_of(1)), scene_of(2)), Error);
}

TEST(DiskCache, RecallsWhatARunHasStoredWhateverItsNumbers) {
  TemporaryFolder const folder;
  Cached cached(folder.path());
  cached.open().store(some_answers());
  expect_some_answers(cached.stored());

  auto cache = cached.open();
  SceneAnswers run;
  run.receivers = {3, 8};  // 7 is not asked for, 8 is new
  run.states.number_of({0.0, 0.0});
  auto const half = run.states.number_of({0.5, 1.0});
  auto& direction = run.answers.at(noon, half);
  cache.recall(run, direction);
  EXPECT_EQ(direction.area(0, std::vector<double>{1.0, 1.0, 1.0}), 2.5 + 0.5 + 0.125);
  EXPECT_EQ(direction.error(0), 0.25);
  EXPECT_FALSE(direction.knows(1));
  auto const* const interior = cache.recall_interior(run, direction, 99);
  ASSERT_TRUE(interior != nullptr);
  EXPECT_EQ(direction.interior_area[interior->first], 0.75F);
  EXPECT_EQ(direction.sunlit(*interior).front().error, std::nullopt);
  EXPECT_EQ(cache.recall_interior(run, direction, 98), nullptr);
  EXPECT_EQ(cache.directions_recalled(), 1U);

  auto& elsewhere = run.answers.at({0.1, 0.8}, half);
  cache.recall(run, elsewhere);
  EXPECT_FALSE(elsewhere.recalled);
  auto& other_state = run.answers.at(noon, 0);
  cache.recall(run, other_state);
  EXPECT_FALSE(other_state.recalled);
  EXPECT_THAT(cached.remarks, testing::IsEmpty());
}

TEST(DiskCache, StoringAddsToWhatAnotherRunHasStoredMeanwhile) {
  TemporaryFolder const folder;
  Cached cached(folder.path());
  auto first = cached.open();
  auto second = cached.open();
  SceneAnswers other;
  other.receivers = {5, 3};
  auto const half = other.states.number_of({0.5, 1.0});
  other.answers.keep(other.answers.at(noon, half), 0, lit(4.0));
  other.answers.keep(other.answers.at({2.0, 0.5}, half), 1, lit(5.0));
  first.store(some_answers());
  second.store(other);
  auto const all = cached.stored();
  EXPECT_EQ(all.receivers, (std::vector<SurfaceId>{7, 3, 5}));
  EXPECT_EQ(all.answers.size(), 3U);
  auto const* const direction = all.answers.find(noon, 1);
  ASSERT_TRUE(direction != nullptr);
  EXPECT_TRUE(direction->knows(1) && direction->knows(2));
  EXPECT_TRUE(direction->interior.contains(99));
}

TEST(DiskCache, OtherScenesHaveOtherFiles) {
  TemporaryFolder const folder;
  Cached one(folder.path(), 1);
  Cached two(folder.path(), 2);
  one.open().store(some_answers());
  SceneAnswers run = some_answers();
  run.answers = AnswerStore();
  auto& direction = run.answers.at(noon, 0);
  two.open().recall(run, direction);
  EXPECT_FALSE(direction.knows(0));
}

TEST(DiskCache, ImpossibleAnswersAreNotBelieved) {
  auto const with = [](Sunlit const& answer) {
    SceneAnswers set = some_answers();
    set.answers.keep(set.answers.at(noon, 0), 0, answer);
    return set;
  };
  auto const inside = [](Sunlit const& answer) {
    SceneAnswers set = some_answers();
    set.answers.keep_interior(set.answers.at(noon, 0), 5, {answer});
    return set;
  };
  auto const foreign = [] {
    SceneAnswers set = some_answers();
    set.receivers[1] = 10;
    return set;
  };
  std::vector<SceneAnswers> sets;
  sets.push_back(with(lit(30.001)));
  sets.push_back(with(lit(-0.001)));
  sets.push_back(with(lit(std::numeric_limits<double>::infinity())));
  sets.push_back(with(lit(1.0, {{{{3, 1}}, 0.5}})));
  sets.push_back(with(lit(1.0, {{{{-1, 1}}, 0.5}})));
  sets.push_back(with(lit(1.0, {{{{0, 1}}, -0.5}})));
  sets.push_back(with(lit(29.0, {{{{0, 1}}, 2.0}})));
  sets.push_back(inside(lit(31.0)));
  sets.push_back(inside(lit(std::numeric_limits<double>::quiet_NaN())));
  sets.push_back(with(lit(1.0, {}, -0.5)));
  sets.push_back(foreign());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    TemporaryFolder const folder;
    Cached cached(folder.path());
    cached.open().store(sets[i]);  // with the right checksum
    auto cache = cached.open();
    EXPECT_THAT(cached.remarks,
                testing::ElementsAre(HasSubstr("holds answers that are not possible")))
        << i;
    auto run = some_answers();
    run.answers = AnswerStore();
    auto& direction = run.answers.at(noon, 1);
    cache.recall(run, direction);
    EXPECT_FALSE(direction.recalled) << i;
  }
}

TEST(DiskCache, PipesAreNotWaitedFor) {
  TemporaryFolder const folder;
  Cached cached(folder.path());
  ASSERT_EQ(mkfifo(cached.file().c_str(), 0600), 0);
  auto cache = cached.open();
  EXPECT_THAT(cached.remarks, testing::ElementsAre(HasSubstr("cannot be read")));
  EXPECT_THROW(cache.store(some_answers()), Error);
}

TEST(DiskCache, DamagedFileIsIgnoredWithARemarkAndReplaced) {
  TemporaryFolder const folder;
  Cached cached(folder.path());
  write(cached.file(), "not ours at all, though it has our name");
  auto cache = cached.open();
  ASSERT_EQ(cached.remarks.size(), 1U);
  EXPECT_THAT(cached.remarks[0], HasSubstr(cached.file().string() + " is "));
  EXPECT_THAT(cached.remarks[0], HasSubstr("ignored"));
  cache.store(some_answers());
  expect_some_answers(cached.stored());
}

TEST(DiskCache, ReadOnlyRecallsAndWritesNothing) {
  TemporaryFolder const folder;
  Cached cached(folder.path());
  cached.open().store(some_answers());
  auto const long_ago = fs::file_time_type::clock::now() - std::chrono::hours(9);
  fs::last_write_time(cached.file(), long_ago);
  auto const before = read(cached.file());
  auto reader = cached.open_read_only();
  auto run = some_answers();
  run.answers = AnswerStore();
  auto& direction = run.answers.at(noon, 1);
  reader.recall(run, direction);
  EXPECT_TRUE(direction.recalled);
  run.answers.keep(run.answers.at({0.5, 0.5}, 1), 0, lit(3.0));
  reader.store(run);
  EXPECT_EQ(read(cached.file()), before);
  EXPECT_EQ(fs::last_write_time(cached.file()), long_ago);
  Cached other(folder.path(), 2);
  other.open_read_only().store(some_answers());
  EXPECT_FALSE(fs::exists(other.file()));
}

TEST(DiskCache, FolderIsBoundedAndWhatIsNotOursStays) {
  TemporaryFolder const folder;
  auto const hour = std::chrono::hours(1);
  auto const now = fs::file_time_type::clock::now();
  std::vector<std::string> const foreign{"notes.txt",
                                         "model.sunlit",
                                         std::string(32, 'g') + ".sunlit",
                                         std::string(31, 'a') + ".sunlit",
                                         std::string(32, 'a') + ".sunlit.bak",
                                         std::string(32, 'A') + ".sunlit"};
  for (auto const& name : foreign) {
    write(folder.path() / name, std::string(10'000, 'x'));
    fs::last_write_time(folder.path() / name, now - 100 * hour);
  }
  fs::create_directory(folder.path() / cache_file_name(std::string(32, 'd')));
  std::vector<Cached> cached;
  for (std::uint8_t i = 0; i < 4; ++i) {
    cached.emplace_back(folder.path(), i).open().store(some_answers());
    fs::last_write_time(cached.back().file(), now - (10 - i) * hour);
  }
  cached[0].open();  // is used last now
  auto const size = fs::file_size(cached[0].file());
  Cached last(folder.path(), 9);
  last.open(3 * size).store(some_answers());
  EXPECT_TRUE(fs::exists(cached[0].file()));
  EXPECT_FALSE(fs::exists(cached[1].file()));
  EXPECT_FALSE(fs::exists(cached[2].file()));
  EXPECT_TRUE(fs::exists(cached[3].file()));
  EXPECT_TRUE(fs::exists(last.file()));
  last.open(1).store(some_answers());
  EXPECT_FALSE(fs::exists(cached[3].file()));
  EXPECT_TRUE(fs::exists(last.file())) << "the one just written stays, whatever it takes";
  for (auto const& name : foreign) EXPECT_TRUE(fs::exists(folder.path() / name)) << name;
  EXPECT_TRUE(fs::is_directory(folder.path() / cache_file_name(std::string(32, 'd'))));
}

TEST(DiskCache, FailedWriteLeavesWhatWasThereAndNothingElse) {
  TemporaryFolder const folder;
  Cached cached(folder.path());
  cached.open().store(some_answers());
  auto cache = cached.open();
  auto more = some_answers();
  for (int i = 0; i < 1000; ++i)
    more.answers.keep(more.answers.at({i * 1e-3, 0.1}, 0), 0, lit(1.0));

  // As a full disk would, but for the name of the trouble.
  auto* const before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  rlimit const small{4096, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message = "stored";
  try {
    cache.store(more);
  } catch (Error const& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, before);

  EXPECT_THAT(message, HasSubstr(cached.file().string() + ": cannot be written (File too large)"));
  expect_some_answers(cached.stored());
  std::set<std::string> names;
  for (auto const& entry : fs::directory_iterator(folder.path())) {
    names.insert(entry.path().filename());
  }
  EXPECT_EQ(names, (std::set<std::string>{cached.file().filename(), std::string(cache_lock_name)}));
}

// Each process stores its own direction again and again, and reads what is there.
TEST(DiskCache, ManyProcessesStoreIntoOneFolder) {
  constexpr int processes = 6;
  constexpr int rounds = 15;
  TemporaryFolder const folder;
  std::vector<pid_t> children;
  for (int process = 0; process < processes; ++process) {
    pid_t const child = fork();
    ASSERT_GE(child, 0);
    if (child > 0) {
      children.push_back(child);
      continue;
    }
    int status = 0;
    try {
      for (int round = 0; round < rounds; ++round) {
        Cached cached(folder.path());
        auto cache = cached.open();
        SceneAnswers run;
        run.receivers = {static_cast<SurfaceId>(process)};
        auto const state = run.states.number_of({});
        run.answers.keep(run.answers.at({process * 0.1, round * 0.01}, state), 0,
                         lit(process + round));
        cache.store(run);
        if (!cached.remarks.empty()) status = 1;
      }
    } catch (std::exception const&) {
      status = 2;
    }
    _exit(status);
  }
  for (pid_t const child : children) {
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }
  auto const all = Cached(folder.path()).stored();
  EXPECT_EQ(all.receivers.size(), processes);
  EXPECT_EQ(all.answers.size(), processes * rounds) << "what one stored another has lost";
  all.answers.for_each([&](AnswerStore::Direction const& direction) {
    for (ReceiverNumber number = 0; number < direction.projected_area.size(); ++number) {
      if (!direction.knows(number)) continue;
      EXPECT_FLOAT_EQ(direction.projected_area[number],
                      static_cast<float>(all.receivers[number] + direction.sun.altitude * 100));
    }
  });
}

TEST(CacheFolder, IsMadeWhereMissingAndRefusedWhereItCannotBeWrittenTo) {
  TemporaryFolder const folder;
  prepare_cache_folder({folder.path() / "a" / "b"});
  EXPECT_TRUE(fs::is_directory(folder.path() / "a" / "b"));
  prepare_cache_folder({.path = folder.path() / "a", .read_only = true});
  EXPECT_THROW(prepare_cache_folder({.path = folder.path() / "c", .read_only = true}), Error);
  EXPECT_FALSE(fs::exists(folder.path() / "c"));
  write(folder.path() / "file", "");
  for (auto const& bad :
       {folder.path() / "file", fs::path("/proc/nothing/here"), folder.path() / "file" / "below"}) {
    try {
      prepare_cache_folder({bad});
      FAIL() << bad;
    } catch (Error const& error) {
      EXPECT_THAT(error.what(), HasSubstr("--gpu-shading-cache: " + bad.string()));
    }
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus
