#include "answers/answer_errors.h"

#include <gtest/gtest.h>

namespace gpu_shading::energyplus {
namespace {

TEST(AnswerErrors, OfExactViewsAreRounding) {
  AnswerErrors errors;
  errors.add(7, 0.0);
  errors.add(8, 0.0);
  EXPECT_EQ(errors.exact(), 2U);
  EXPECT_EQ(errors.sampled() + errors.not_measured(), 0U);
  EXPECT_EQ(errors.largest(), Sunlit::rounding);
  EXPECT_EQ(errors.within(0.99), Sunlit::rounding);
  EXPECT_EQ(errors.largest_of(7), Sunlit::rounding);
  EXPECT_TRUE(errors.all_measured_of(7));
}

// 1,000 views of two receivers, gathered in two parts.
TEST(AnswerErrors, AreCountedFromTheSmallestToTheLargest) {
  AnswerErrors errors;
  AnswerErrors later;
  for (int i = 1; i <= 1000; ++i) {
    (i % 3 == 0 ? errors : later).add(i % 2 == 0 ? 4 : 5, i * 1e-6);
    errors.add(6, 0.0);
  }
  errors += later;
  EXPECT_EQ(errors.sampled(), 1000U);
  EXPECT_EQ(errors.exact(), 1000U);
  for (double const share : {0.001, 0.5, 0.99}) {
    double const expected = 1e-3 * share;
    EXPECT_GE(errors.within(share), expected * (1.0 - 1e-6)) << share;
    EXPECT_LE(errors.within(share), expected * 1.01) << share;
  }
  EXPECT_EQ(errors.within(1.0), 1e-3);
  EXPECT_EQ(errors.largest(), 1e-3);
  EXPECT_EQ(errors.largest_of(4), 1e-3);
  EXPECT_DOUBLE_EQ(errors.largest_of(5), 999e-6);
}

TEST(AnswerErrors, ThatWereNotMeasuredAreCountedApart) {
  AnswerErrors errors;
  errors.add(4, std::nullopt);
  errors.add(4, 1e-3);
  AnswerErrors later;
  later.add(5, std::nullopt);
  errors += later;
  EXPECT_EQ(errors.not_measured(), 2U);
  EXPECT_EQ(errors.sampled(), 1U);
  EXPECT_EQ(errors.largest_of(4), 1e-3);
  EXPECT_FALSE(errors.all_measured_of(4));
  EXPECT_FALSE(errors.all_measured_of(5));
  EXPECT_TRUE(errors.all_measured_of(6));
}

}  // namespace
}  // namespace gpu_shading::energyplus
