#include "slipnav/core/ekf/adaptation/slipping_speed.h"

#include <gtest/gtest.h>

namespace slipnav::test {
namespace {

TEST(SlippingSpeed, AWheelThatRunsAheadDoesNotChangeIt) {
  SlippingSpeed speed;
  for (int i = 0; i < 40; ++i) {
    speed.add(i * kSecond / 10, i >= 20 && i < 25 ? 1.2 : 0.8);
    EXPECT_EQ(speed.value(), 0.8) << i;
  }
}

TEST(SlippingSpeed, FollowsABrakingRoverAtOnceAndAFasterOneAfterASecond) {
  SlippingSpeed speed;
  speed.add(0, -0.8);
  speed.add(kSecond / 10, -0.3);
  EXPECT_EQ(speed.value(), -0.3);
  for (int i = 2; i <= 12; ++i) {
    speed.add(i * kSecond / 10, -0.9);
  }
  EXPECT_EQ(speed.value(), -0.9);
  speed.reset();
  EXPECT_EQ(speed.value(), 0.0);
}

}  // namespace
}  // namespace slipnav::test
