#include "slipnav/core/ekf/engine/runaway_watch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipnav::test {
namespace {

constexpr double kStep_s = 0.1;
constexpr double kGravity_mps2 = 9.81;

/// How often it has run away in `duration_s` of the same speeds, negative against the wheels.
int ranAway(RunawayWatch& watch, double wheels_mps, double forward_mps, double duration_s, Nanoseconds& now) {
  int count = 0;
  for (Nanoseconds end = now + fromSeconds(duration_s); now < end;) {
    now += fromSeconds(kStep_s);
    count += watch.addWheels(now, wheels_mps, std::abs(forward_mps), -forward_mps, kStep_s) ? 1 : 0;
  }
  return count;
}

class Runaway : public ::testing::Test {
 protected:
  RunawayWatch watch_;
  Nanoseconds now_ = fromSeconds(100.0);
};

TEST_F(Runaway, IsTwiceTheFastestForASecond) {
  EXPECT_EQ(ranAway(watch_, 1.0, 1.9, 60.0, now_), 0);
  EXPECT_EQ(ranAway(watch_, 1.0, 2.1, 0.9, now_), 0);
  EXPECT_EQ(ranAway(watch_, 1.0, 2.1, 0.2, now_), 1);
  EXPECT_NEAR(watch_.wayBeyond_m(), 60.0 * 0.9 + 1.1 * 1.1, 0.3);
}

/// Slip of more than all: a vehicle that stands on spinning wheels may seem to move back a little.
TEST_F(Runaway, IsAQuarterAgainstTheWheelsForASecond) {
  EXPECT_EQ(ranAway(watch_, 0.8, -0.19, 60.0, now_), 0);
  EXPECT_EQ(ranAway(watch_, 0.8, 0.8, 1.0, now_), 0);
  EXPECT_EQ(ranAway(watch_, 0.8, 0.2, 4.0, now_), 0) << "slip of three quarters";
  EXPECT_EQ(ranAway(watch_, 0.8, -0.21, 1.15, now_), 1);
  EXPECT_NEAR(watch_.wayBeyond_m(), 4.0 * 0.6 + 1.1 * 1.01, 0.15);
}

TEST_F(Runaway, IsSaidAgainWhileItLasts) { EXPECT_EQ(ranAway(watch_, 1.0, 9.0, 5.05, now_), 4); }

TEST_F(Runaway, TheFastestIsThatOfTheWholeDrive) {
  ranAway(watch_, 3.0, 3.0, 1.0, now_);
  EXPECT_EQ(ranAway(watch_, 0.2, 5.0, 30.0, now_), 0);
  EXPECT_DOUBLE_EQ(watch_.fastest_mps(), 3.0);
}

/// Locked on a slope, or carried: nothing that the wheels could say.
TEST_F(Runaway, WheelsAtRestSayNothing) { EXPECT_EQ(ranAway(watch_, 0.0, 9.0, 30.0, now_), 0); }

TEST_F(Runaway, AMomentOfAgreementEndsIt) {
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(ranAway(watch_, 1.0, 9.0, 0.75, now_), 0);
    EXPECT_EQ(ranAway(watch_, 1.0, 1.0, 0.05, now_), 0);
  }
}

TEST_F(Runaway, TheLevelIsThatOfTheLastSeconds) {
  for (int i = 0; i < 100; ++i) {
    watch_.addImu({3.0, 0.0, -9.0}, kStep_s);
  }
  for (int i = 0; i < 600; ++i) {
    watch_.addImu({0.0, i % 2 == 0 ? 2.0 : -2.0, -kGravity_mps2}, kStep_s);
  }
  EXPECT_NEAR(watch_.level().x(), 0.0, 5e-3);
  EXPECT_NEAR(watch_.level().y(), 0.0, 1e-4);
  ranAway(watch_, 2.0, 2.0, 1.0, now_);
  EXPECT_NEAR(watch_.levelStd_rad(kGravity_mps2), 2.0 / 5.0 / kGravity_mps2, 1e-9);
}

TEST_F(Runaway, IsNoneAtExactlyTwiceTheFastest) { EXPECT_EQ(ranAway(watch_, 1.0, 2.0, 60.0, now_), 0); }

/// As at the start of a drive: a tenth of a meter per second is what they may do at any moment.
TEST_F(Runaway, WheelsThatHardlyTurnAreNoMeasure) {
  EXPECT_EQ(ranAway(watch_, 0.02, 0.19, 60.0, now_), 0);
  EXPECT_EQ(ranAway(watch_, 0.02, 0.21, 1.15, now_), 1);
}

TEST_F(Runaway, TheWayIsThatOfTheLastTime) {
  ranAway(watch_, 1.0, 9.0, 0.5, now_);
  ranAway(watch_, 1.0, 1.0, 0.1, now_);
  EXPECT_EQ(ranAway(watch_, 1.0, 3.0, 1.15, now_), 1);
  EXPECT_NEAR(watch_.wayBeyond_m(), 11.0 * 2.0 * kStep_s, 1e-12);
}

TEST_F(Runaway, OneLongStepIsAllThatIsKnownOfTheLevel) {
  EXPECT_NEAR(watch_.levelStd_rad(kGravity_mps2), 0.1 / 0.1 / kGravity_mps2, 1e-12) << "nothing is known";
  watch_.addImu({3.0, 0.0, -4.0}, 20.0);
  EXPECT_NEAR(watch_.level().y(), std::atan2(3.0, 4.0), 1e-12);
  EXPECT_NEAR(watch_.levelStd_rad(kGravity_mps2), 0.1 / 5.0 / kGravity_mps2, 1e-12);
}

}  // namespace
}  // namespace slipnav::test
