// Included before Penumbra's tests: they allow errors of 0.01, here a tenth of it.
#include <gtest/gtest.h>

#undef EXPECT_NEAR
#define EXPECT_NEAR(value, expected, error) \
  EXPECT_PRED_FORMAT3(::testing::internal::DoubleNearPredFormat, value, expected, (error) / 10.0)
