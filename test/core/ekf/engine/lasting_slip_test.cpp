#include "slipnav/core/ekf/engine/lasting_slip.h"

#include <gtest/gtest.h>

namespace slipnav::test {
namespace {

constexpr double kLength_m = 0.5;
constexpr double kStd = 0.07;
constexpr double kStep_m = 0.08;

/// How often the slip has lasted, over `way_m` of the same slip.
int lasted(LastingSlip& lasting, double slip, double way_m) {
  int count = 0;
  for (double s_m = 0.0; s_m < way_m; s_m += kStep_m) {
    count += lasting.add(slip, kStd, kStep_m, kLength_m) ? 1 : 0;
  }
  return count;
}

TEST(LastingSlip, OfFourLengthsIsPersistent) {
  LastingSlip lasting;
  EXPECT_EQ(lasted(lasting, 0.5, 1.9), 0);
  EXPECT_EQ(lasted(lasting, 0.5, 0.4), 1);
}

TEST(LastingSlip, IsSaidOnceForEachSuchWay) {
  LastingSlip lasting;
  EXPECT_EQ(lasted(lasting, -0.9, 6.5), 3);
}

TEST(LastingSlip, WhatTheGroundIsKnownForIsNone) {
  LastingSlip lasting;
  EXPECT_EQ(lasted(lasting, 2.9 * kStd, 50.0), 0);
  EXPECT_GT(lasted(lasting, 3.1 * kStd, 50.0), 0);
}

TEST(LastingSlip, ThatChangesSidesIsFast) {
  LastingSlip lasting;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(lasted(lasting, i % 2 == 0 ? 0.5 : -0.5, 1.0), 0);
  }
}

TEST(LastingSlip, StartsAgainWhereAWheelHasGripped) {
  LastingSlip lasting;
  EXPECT_EQ(lasted(lasting, 0.5, 1.8), 0);
  EXPECT_EQ(lasted(lasting, 0.0, 0.05), 0);
  EXPECT_EQ(lasted(lasting, 0.5, 1.8), 0);
}

/// Lengths and deviations that are exact in binary.
TEST(LastingSlip, MoreThanFourLengthsOfMoreThanThreeDeviations) {
  LastingSlip lasting;
  lasting.add(0.5, 0.125, 0.5, 0.5);
  EXPECT_FALSE(lasting.add(0.5, 0.125, 2.0, 0.5)) << "four lengths";
  EXPECT_TRUE(lasting.add(0.5, 0.125, 0.125, 0.5));
  for (const double side : {1.0, -1.0}) {
    lasting.reset();
    lasting.add(side * 0.375, 0.125, 8.0, 0.5);
    EXPECT_FALSE(lasting.add(side * 0.375, 0.125, 8.0, 0.5)) << "three deviations";
  }
}

}  // namespace
}  // namespace slipnav::test
