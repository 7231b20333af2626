#include "core/stopping/stop_ramp.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipnav {
namespace {

constexpr double kDeceleration_mps2 = 0.5;
constexpr double kAngularDeceleration_radps2 = 0.25;
constexpr Nanoseconds kStep = 100'000'000;

VelocityCommand ahead(double speed_mps, double rate_radps = 0.0) {
  VelocityCommand command;
  command.linear_mps.x() = speed_mps;
  command.angular_radps.z() = rate_radps;
  return command;
}

class StopRampTest : public ::testing::Test {
 protected:
  VelocityCommand shorten(const VelocityCommand& command) { return ramp_.shorten(command, stamp_ += kStep); }

  StopRamp ramp_{kDeceleration_mps2, kAngularDeceleration_radps2};
  Nanoseconds stamp_ = kSecond;
};

TEST_F(StopRampTest, SlowsDownByTheDeceleration) {
  for (const double speed_mps : {0.4, 1.0, -2.0}) {
    stamp_ = kSecond;
    ramp_.begin(stamp_, std::abs(speed_mps));
    const double sign = speed_mps > 0.0 ? 1.0 : -1.0;
    for (int i = 1; i <= 5; ++i) {
      EXPECT_NEAR(shorten(ahead(speed_mps)).linear_mps.x(), speed_mps - sign * 0.05 * i, 1e-12) << speed_mps;
    }
  }
}

TEST_F(StopRampTest, KeepsTheCurvatureAtTheGentlerOfBothRamps) {
  ramp_.begin(stamp_, 0.2);
  for (int i = 1; i <= 19; ++i) {
    const VelocityCommand out = shorten(ahead(0.2, 0.5));  // two seconds for the turn, 0.4 s for the speed
    EXPECT_NEAR(out.angular_radps.z(), 0.5 - 0.025 * i, 1e-12);
    EXPECT_NEAR(out.linear_mps.x() / out.angular_radps.z(), 0.4, 1e-12);
  }
  shorten(ahead(0.2, 0.5));
  EXPECT_TRUE(shorten(ahead(0.2, 0.5)).isZero());
}

/// A faster command while the rover stops gives no more speed than it still has.
TEST_F(StopRampTest, NeverSpeedsUpAgain) {
  ramp_.begin(stamp_, 0.4);
  double last_mps = 0.4;
  for (const double wanted_mps : {0.4, 0.4, 0.8, 2.0, 0.4, 0.8}) {
    const double speed_mps = shorten(ahead(wanted_mps)).linear_mps.x();
    EXPECT_LE(speed_mps, last_mps + 1e-12);
    last_mps = speed_mps;
  }
}

TEST_F(StopRampTest, ACommandOfZeroEndsIt) {
  ramp_.begin(stamp_, 1.0);
  EXPECT_TRUE(shorten(ahead(0.0)).isZero());
  EXPECT_TRUE(shorten(ahead(1.0)).isZero());
}

}  // namespace
}  // namespace slipnav
