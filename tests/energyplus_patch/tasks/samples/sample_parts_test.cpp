#include "tasks/samples/sample_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <future>
#include <glm/geometric.hpp>
#include <sstream>

#include "gpu_shading/error.h"
#include "platform/files.h"
#include "platform/process.h"
#include "scene/digest.h"
#include "tasks/samples/sample_set.h"
#include "tasks/samples/take_samples.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double latitude = 0.7;
constexpr Sampling coarse{Sampling::Density::coarse, false};

SampledScene const scene{
    "coarse",
    "0f",
    "error 0.001",
    {{"South, \"main\"", {0.0, -2.0, 0.0}}, {"West", {-3.0, 0.0, 0.0}}, {"Roof", {0.0, 0.0, 9.0}}},
    {"Leaves", "Blind"}};

// Some of it through schedules; a third of one has no short decimal form.
Sunlit answer(glm::dvec3 const& area, SunDirection sun) {
  double const projected = std::max(glm::dot(area, to_vector(sun)), 0.0);
  Sunlit lit;
  lit.projected_area = projected * (sun.azimuth > 0.5 && sun.altitude < 0.6 ? 1.0 / 3.0 : 0.9);
  if (sun.altitude > 0.3) lit.scheduled.push_back({{{0, 1}, {1, 2}}, projected / 30.0});
  return lit;
}

// Counts what it is asked.
struct Rendered {
  std::size_t directions = 0;

  SunlitSource source() {
    return [this](std::span<SunDirection const> suns) {
      directions += suns.size();
      std::vector<std::vector<Sunlit>> rows;
      for (auto const sun : suns) {
        auto& row = rows.emplace_back();
        for (auto const& receiver : scene.receivers) row.push_back(answer(receiver.area, sun));
      }
      return rows;
    };
  }
};

SampleRequest request(std::filesystem::path const& folder, Shard shard) {
  return {"coarse", latitude, folder, shard};
}

std::string table_of(SampleParts const& parts) {
  std::ostringstream out;
  write_samples(gather_samples(parts, "coarse", coarse, latitude), out);
  return out.str();
}

TEST(SampleParts, EightShardsMakeTheTableOfOne) {
  TemporaryFolder const one;
  TemporaryFolder const many;
  Rendered alone;
  take_samples(request(one.path(), {1, 1}), coarse, scene, "device", alone.source());
  Rendered together;
  auto const take = [&](int shard) {
    return take_samples(request(many.path(), {shard, 8}), coarse, scene, "device",
                        together.source());
  };
  int rounds = 0;
  for (auto line = take(3); line.find("complete") == std::string::npos; line = take(3)) {
    auto const round = "round " + std::to_string(++rounds) + ": ";
    EXPECT_THAT(line, HasSubstr(round));
    // In any order.
    for (int const shard : {1, 8, 2, 7, 6, 4, 5}) EXPECT_THAT(take(shard), HasSubstr(round));
    ASSERT_LE(rounds, 8);
  }
  EXPECT_GE(rounds, 5);
  EXPECT_EQ(together.directions, alone.directions);
  EXPECT_THAT(take(5), HasSubstr("all " + std::to_string(rounds) + " rounds are complete"));
  EXPECT_EQ(together.directions, alone.directions);
  auto const table = table_of(SampleParts(one.path(), 1));
  EXPECT_EQ(table_of(SampleParts(many.path(), 8)), table);
  EXPECT_THAT(table, HasSubstr("\n\"South, \"\"main\"\"\","));
  EXPECT_THAT(table, HasSubstr(",Leaves*Blind^2,"));
}

TEST(SampleParts, ShardsThatWaitGoThroughAllRounds) {
  TemporaryFolder const one;
  TemporaryFolder const many;
  Rendered alone;
  auto const line =
      take_samples(request(one.path(), {1, 1}), coarse, scene, "device", alone.source());
  auto const take = [&](int shard, double wait) {
    auto each = request(many.path(), {shard, 2});
    each.wait = wait;
    Rendered rendered;
    return take_samples(each, coarse, scene, "device", rendered.source());
  };
  EXPECT_THAT(take(1, 0.01), HasSubstr("directions rendered, waiting for shards 2"));
  constexpr double long_enough = 60.0;
  auto other = std::async(std::launch::async, take, 2, long_enough);
  auto const rounds = line.substr(line.find("all "));
  EXPECT_THAT(take(1, long_enough), HasSubstr(rounds));
  EXPECT_THAT(other.get(), HasSubstr(rounds));
  EXPECT_EQ(table_of(SampleParts(many.path(), 2)), table_of(SampleParts(one.path(), 1)));
}

std::string text_of(std::filesystem::path const& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(SampleParts, DamageAnywhereIsSeen) {
  TemporaryFolder const folder;
  SampleParts const parts(folder.path(), 1);
  SamplePart part{scene, "device", 1, {1, 1}, {{0.1, 0.2}}, {}};
  part.answers.push_back({answer(scene.receivers[0].area, part.directions[0]), {}, {}});
  parts.write(part);
  auto const path = parts.file(1, 1);
  auto const good = text_of(path);
  ASSERT_TRUE(parts.find(1, 1));
  for (std::size_t i = 0; i < good.size(); ++i) {
    auto bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    std::ofstream(path) << bad;
    EXPECT_THROW(parts.find(1, 1), Error) << i;
    std::ofstream(path) << good.substr(0, i);
    EXPECT_THROW(parts.find(1, 1), Error) << i;
  }
}

TEST(SampleParts, ImpossibleAnswersAreNotBelieved) {
  auto const refused = [](auto const& change) {
    TemporaryFolder const folder;
    SampleParts const parts(folder.path(), 1);
    SamplePart part{scene, "device", 1, {1, 1}, {{0.1, 0.2}}, {}};
    part.answers.emplace_back(3);
    part.answers[0][1] = answer({0.0, 0.0, 1.0}, {0.1, 0.4});
    change(part);
    parts.write(part);
    EXPECT_THAT([&] { parts.find(1, 1); }, ThrowsMessage<Error>(HasSubstr("not possible")));
  };
  refused([](SamplePart& part) { part.answers[0][0].projected_area = 2.001; });
  refused([](SamplePart& part) { part.answers[0][0].projected_area = -0.001; });
  refused([](SamplePart& part) { part.answers[0][0].projected_area = 1e308; });
  refused([](SamplePart& part) { part.answers[0][1].scheduled[0].projected_area = 4.0; });
  refused([](SamplePart& part) { part.answers[0][1].scheduled[0].powers[0].first = 2; });
  refused([](SamplePart& part) { part.answers[0][1].scheduled[0].powers[0].second = -1; });
}

// With the right checksum, as from a program that writes numbers in another way.
TEST(SampleParts, CountsAreWholeNumbers) {
  TemporaryFolder const folder;
  SampleParts const parts(folder.path(), 1);
  parts.write({{"coarse", "0f", "error 0.001", {}, {}}, "device", 1, {1, 1}, {}, {}});
  auto const file = parts.file(1, 1);
  std::string const head = "{\"xxh128\":\"";
  auto const first = head.size() + to_text(Hash{}).size() + std::string("\",").size();
  auto const contents = read_text_file(file).substr(first);
  std::string const round = "\"round\":1";
  auto const at = contents.find(round);
  ASSERT_NE(at, std::string::npos);
  auto const find_with = [&](std::string const& number) {
    auto changed = contents;
    changed.replace(at, round.size(), "\"round\":" + number);
    Digest digest;
    digest.add(std::string_view(changed).substr(0, changed.size() - 1));
    std::ofstream(file) << head << to_text(digest.result()) << "\"," << changed;
    return parts.find(1, 1);
  };
  EXPECT_TRUE(find_with("1"));
  for (auto const* const number : {"1e300", "1.5", "4294967297", "-4294967295", "true"}) {
    EXPECT_THAT([&] { find_with(number); }, ThrowsMessage<Error>(HasSubstr("not possible")))
        << number;
  }
}

TEST(SampleParts, ARoundWaitsForAllShardsOfTheOneBefore) {
  TemporaryFolder const folder;
  Rendered rendered;
  auto const take = [&](int shard) {
    return take_samples(request(folder.path(), {shard, 3}), coarse, scene, "device",
                        rendered.source());
  };
  EXPECT_THAT(take(2), HasSubstr("2 of 3 shards left"));
  auto const before = rendered.directions;
  EXPECT_THAT(take(2), HasSubstr("round 1: nothing to render, waiting for shards 1, 3"));
  EXPECT_EQ(rendered.directions, before);
  EXPECT_THAT([&] { gather_samples(SampleParts(folder.path(), 3), "coarse", coarse, latitude); },
              ThrowsMessage<Error>(HasSubstr("round1-shard1of3.json: is missing")));
  take(1);
  EXPECT_THAT([&] { gather_samples(SampleParts(folder.path(), 3), "coarse", coarse, latitude); },
              ThrowsMessage<Error>(HasSubstr("render shards 3 of round 1 first")));
}

TEST(SampleParts, ComeBackToTheLastDigit) {
  TemporaryFolder const folder;
  SampleParts const parts(folder.path() / "new", 2);
  SamplePart part{scene, "device", 3, {2, 2}, {{0.1, 0.2}, {1.0 / 3.0, 0.7}}, {}};
  part.answers.emplace_back();
  for (auto const& receiver : scene.receivers) {
    part.answers.back().push_back(answer(receiver.area, part.directions[1]));
  }
  parts.write(part);
  auto const found = parts.find(3, 2);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->scene, scene);
  EXPECT_EQ(found->device, "device");
  EXPECT_EQ(found->directions, part.directions);
  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    auto const& [written, read] = std::tie(part.answers[0][i], found->answers[0][i]);
    EXPECT_EQ(read.projected_area, written.projected_area);
    ASSERT_EQ(read.scheduled.size(), written.scheduled.size());
    for (std::size_t k = 0; k < read.scheduled.size(); ++k) {
      EXPECT_EQ(read.scheduled[k].powers, written.scheduled[k].powers);
      EXPECT_EQ(read.scheduled[k].projected_area, written.scheduled[k].projected_area);
    }
  }
  EXPECT_FALSE(parts.find(3, 1));
}

TEST(SampleParts, OfAnotherSceneCountAsMissingAndAreReplaced) {
  TemporaryFolder const folder;
  Rendered rendered;
  take_samples(request(folder.path(), {1, 1}), coarse, scene, "device", rendered.source());
  auto const before = rendered.directions;
  auto other = scene;
  other.hash = "10";
  take_samples(request(folder.path(), {1, 1}), coarse, other, "device", rendered.source());
  EXPECT_EQ(rendered.directions, 2 * before);
  EXPECT_EQ(SampleParts(folder.path(), 1).find(4, 1)->scene, other);
}

TEST(SampleParts, DirectionsThatDoNotFollowAreAnError) {
  TemporaryFolder const folder;
  SampleParts const parts(folder.path(), 1);
  Rendered rendered;
  take_samples(request(folder.path(), {1, 1}), coarse, scene, "device", rendered.source());
  auto part = parts.find(2, 1);
  ASSERT_TRUE(part);
  part->directions.front().azimuth += 1e-15;
  parts.write(*part);
  EXPECT_THAT([&] { table_of(parts); },
              ThrowsMessage<Error>(HasSubstr("does not match the earlier rounds")));
}

TEST(SampleParts, ADamagedFileIsNamed) {
  TemporaryFolder const folder;
  SampleParts const parts(folder.path(), 1);
  std::ofstream(parts.file(1, 1)) << "{\"format\": 1";
  EXPECT_THAT([&] { parts.find(1, 1); },
              ThrowsMessage<Error>(HasSubstr("round1-shard1of1.json: is not a part of samples")));
}

}  // namespace
}  // namespace gpu_shading::energyplus
