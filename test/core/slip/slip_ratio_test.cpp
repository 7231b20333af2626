#include "core/slip/vehicle_slip.h"

#include <gtest/gtest.h>

#include <limits>

namespace slipnav {
namespace {

constexpr double kLeast = 0.05;

TEST(SlipRatio, DrivingBranch) {
  EXPECT_DOUBLE_EQ(slipRatio(0.6, 0.8, kLeast).value(), 0.25);
  EXPECT_DOUBLE_EQ(slipRatio(0.0, 0.8, kLeast).value(), 1.0);  // spins in place
}

TEST(SlipRatio, BrakingBranch) {
  EXPECT_DOUBLE_EQ(slipRatio(0.8, 0.6, kLeast).value(), -0.25);
  EXPECT_DOUBLE_EQ(slipRatio(0.8, 0.0, kLeast).value(), -1.0);  // slides on a locked wheel
}

TEST(SlipRatio, BranchesMeetAtZero) {
  EXPECT_DOUBLE_EQ(slipRatio(0.8, 0.8, kLeast).value(), 0.0);
  EXPECT_NEAR(slipRatio(0.8, 0.8 * (1.0 + 1e-9), kLeast).value(), 1e-9, 1e-15);
  EXPECT_NEAR(slipRatio(0.8, 0.8 * (1.0 - 1e-9), kLeast).value(), -1e-9, 1e-15);
}

TEST(SlipRatio, ReverseIsMirrored) {
  EXPECT_DOUBLE_EQ(slipRatio(-0.6, -0.8, kLeast).value(), slipRatio(0.6, 0.8, kLeast).value());
  EXPECT_DOUBLE_EQ(slipRatio(-0.8, -0.6, kLeast).value(), slipRatio(0.8, 0.6, kLeast).value());
}

TEST(SlipRatio, StaysWithinItsLimits) {
  EXPECT_DOUBLE_EQ(slipRatio(-0.5, 0.8, kLeast).value(), 1.0);  // rolls back on spinning wheels
  EXPECT_DOUBLE_EQ(slipRatio(0.5, -0.8, kLeast).value(), 1.0);
  EXPECT_DOUBLE_EQ(slipRatio(10.0, 0.1, kLeast).value(), -0.99);
}

TEST(SlipRatio, UndefinedAtStandstillAndForBadNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(slipRatio(0.0, 0.0, kLeast));
  EXPECT_FALSE(slipRatio(0.04, -0.049, kLeast));
  EXPECT_TRUE(slipRatio(0.0, 0.05, kLeast));
  EXPECT_TRUE(slipRatio(-0.05, 0.0, kLeast));
  EXPECT_FALSE(slipRatio(nan, 0.8, kLeast));
  EXPECT_FALSE(slipRatio(0.8, nan, kLeast));
  EXPECT_FALSE(slipRatio(infinity, 0.8, kLeast));
}

}  // namespace
}  // namespace slipnav
