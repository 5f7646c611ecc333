#include "answers/answer_store.h"

#include <gtest/gtest.h>

namespace gpu_shading::energyplus {
namespace {

Sunlit lit(double area) {
  Sunlit answer;
  answer.projected_area = area;
  return answer;
}

TEST(AnswerStore, SameDirectionSameEntry) {
  AnswerStore answers;
  SunDirection const noon{0.1, 0.9};
  EXPECT_FALSE(answers.at(noon, 0).knows(2));
  answers.keep(answers.at(noon, 0), 2, lit(1.5));
  answers.keep(answers.at({0.2, 0.9}, 0), 2, lit(2.5));
  answers.keep(answers.at(noon, 1), 2, lit(3.5));
  EXPECT_EQ(answers.at(noon, 0).area(2, {}), 1.5);
  EXPECT_EQ(answers.at(noon, 1).area(2, {}), 3.5);
  EXPECT_EQ(answers.at(noon, 1).state, 1U);
  EXPECT_FALSE(answers.at(noon, 0).knows(1));
  EXPECT_FALSE(answers.at(noon, 0).knows(3));
}

TEST(AnswerStore, KeepsMeasuredErrors) {
  AnswerStore answers;
  auto& direction = answers.at({0.1, 0.9}, 0);
  auto sampled = lit(1.5);
  sampled.error = 0.25;
  auto unmeasured = lit(2.5);
  unmeasured.error.reset();
  answers.keep(direction, 1, sampled);
  answers.keep(direction, 3, lit(3.5));
  answers.keep(direction, 2, unmeasured);
  auto const inside = answers.keep_interior(direction, 7, {sampled, sampled});
  EXPECT_EQ(direction.sunlit(1).error, 0.25);
  EXPECT_EQ(direction.sunlit(2).error, std::nullopt);
  EXPECT_EQ(direction.sunlit(3).error, 0.0);
  EXPECT_EQ(direction.sunlit(inside).back().error, 0.25);
  answers.keep(direction, 1, lit(1.5));
  EXPECT_EQ(direction.sunlit(1).error, 0.0);
}

// In a model of a hundred thousand surfaces, only those that were asked for take memory.
TEST(AnswerStore, MemoryIsThatOfTheReceivers) {
  AnswerStore answers;
  for (int i = 0; i < 1000; ++i) {
    auto& direction = answers.at({i * 0.001, 0.5}, 0);
    for (ReceiverNumber receiver = 0; receiver < 100; ++receiver) {
      answers.keep(direction, receiver, lit(1.0));
    }
  }
  EXPECT_LT(answers.bytes(), 1000U * (sizeof(AnswerStore::Direction) + 200U * sizeof(float)));
}

TEST(AnswerStore, MemoryIsBounded) {
  constexpr std::size_t most = std::size_t{1} << 20U;
  AnswerStore answers(most);
  Sunlit scheduled = lit(1.0);
  scheduled.scheduled.push_back({{{0, 1}, {1, 2}}, 0.5});
  std::size_t entries = 0;
  for (int i = 0; i < 5000; ++i) {
    if (answers.is_full()) answers.clear();
    auto& direction = answers.at({i * 0.001, 0.5}, 0);
    for (ReceiverNumber receiver = 0; receiver < 10; ++receiver) {
      answers.keep(direction, receiver, scheduled);
    }
    answers.keep_interior(direction, 7, std::vector<Sunlit>(5));
    EXPECT_EQ(direction.area(9, std::vector<double>{1.0, 0.5}), 1.125);
    EXPECT_LE(answers.bytes(), most + 4096);
  }
  answers.for_each([&](auto const&) { ++entries; });
  EXPECT_GT(entries, 0U);
  EXPECT_LT(entries, 5000U);
}

}  // namespace
}  // namespace gpu_shading::energyplus
