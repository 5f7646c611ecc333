#pragma once

#include <gtest/gtest.h>

// For Penumbra's tests, whose tolerances are 0.01 m2.
#undef EXPECT_NEAR
#define EXPECT_NEAR(value, expected, tolerance) \
  EXPECT_PRED_FORMAT3(::testing::internal::DoubleNearPredFormat, value, expected, (tolerance) / 10)
