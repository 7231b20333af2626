#include "core/forecast/recent_drive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

constexpr Nanoseconds kStart = 1'600'000'000'000'000'000;

/// A drive whose heading is the number of its interval.
class RecentDriveTest : public ::testing::Test {
 protected:
  void drive(int intervals, double wheel_speed_mps, double slip, double interval_s = 0.1, bool used = true) {
    for (int i = 0; i < intervals; ++i) {
      now_s_ += interval_s;
      Estimate e;
      e.nav.stamp = kStart + fromSeconds(now_s_);
      e.nav.q_b_to_n = Quaternion(Eigen::AngleAxisd(kTurn_rad * ++count_, Vector3::UnitZ()));
      e.wheels.motion.forward_mps = wheel_speed_mps;
      e.wheel_speed_used = used;
      e.motion = {interval_s, Vector3((1.0 - slip) * wheel_speed_mps, 0.0, 0.0), Vector3::Zero()};
      recent_.add(e);
    }
  }
  void rest(double duration_s) { now_s_ += duration_s; }

  /// Number of the interval that had this attitude.
  static int numberOf(const Quaternion& q) {
    return static_cast<int>(std::lround(Eigen::AngleAxisd(q).angle() / kTurn_rad));
  }

  static constexpr double kTurn_rad = 1e-3;
  ForecastParams params_;
  RecentDrive recent_{params_, false};
  double now_s_ = 0.0;
  int count_ = 0;
};

TEST_F(RecentDriveTest, WindowHoldsFifteenSecondsOfFastDriving) {
  drive(400, 0.8, 0.1);
  const SlipSamples slip = recent_.slip();
  ASSERT_EQ(slip.slips.size(), 150U);
  EXPECT_NEAR(slip.times_s.back(), 14.9, 1e-6);
  EXPECT_NEAR(slip.slips.front(), 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(recent_.intervalsPerSlip(), 1.0);
}

TEST_F(RecentDriveTest, WindowHoldsTwelveMetersOfSlowDriving) {
  drive(6000, 0.04, 0.2);
  const SlipSamples slip = recent_.slip();
  ASSERT_EQ(slip.slips.size(), 150U);
  EXPECT_NEAR(slip.times_s.back() * 0.04, params_.window_m, 0.2);
  EXPECT_NEAR(slip.slips.front(), 0.2, 1e-12);
  EXPECT_NEAR(recent_.intervalsPerSlip(), 20.0, 0.6);
}

/// Velocity errors that come and go are small against a piece of way, large against an interval.
TEST_F(RecentDriveTest, SlipOfASlowRoverIsThatOfItsWay) {
  for (int i = 0; i < 300; ++i) {
    drive(1, 0.04, i % 2 == 0 ? 0.6 : -0.4);
  }
  for (const double slip : recent_.slip().slips) {
    EXPECT_NEAR(slip, 0.1, 0.03);
  }
}

TEST_F(RecentDriveTest, FastWheelsDoNotShortenTheWindow) {
  drive(3000, 0.8, 0.1, 0.02);
  const SlipSamples slip = recent_.slip();
  ASSERT_EQ(slip.slips.size(), 150U);
  EXPECT_NEAR(slip.times_s.back(), 14.9, 0.01);
}

TEST_F(RecentDriveTest, SpotTurnHasNoSlip) {
  drive(600, 0.0, 0.0);
  EXPECT_TRUE(recent_.slip().slips.empty());
  EXPECT_EQ(recent_.cruisingSpeed(), 0.0);
  EXPECT_EQ(recent_.origin(), kStart + fromSeconds(now_s_));
}

TEST_F(RecentDriveTest, MeanSlipIsThatOfTheNewestWaySinceAStop) {
  drive(50, 0.8, 0.1);
  const Nanoseconds stop = kStart + fromSeconds(now_s_);
  EXPECT_NEAR(recent_.meanSlip(2.0, kStart).value(), 0.1, 1e-9);
  EXPECT_FALSE(recent_.meanSlip(5.0, kStart));
  drive(20, 0.8, 0.3);
  EXPECT_FALSE(recent_.meanSlip(2.0, stop));
  EXPECT_NEAR(recent_.meanSlip(1.6, stop).value(), 0.3, 1e-9);
  EXPECT_NEAR(recent_.meanSlip(3.2, kStart).value(), 0.2, 0.01);
}

TEST_F(RecentDriveTest, ImpulsesAreLeftOutUnlessAllAreAskedFor) {
  drive(20, 0.8, 0.1);
  drive(20, 0.8, 0.5, 0.1, false);
  EXPECT_EQ(recent_.slip().slips.size(), 20U);
  EXPECT_DOUBLE_EQ(recent_.wheelShare(), 0.5);
  recent_.retune(params_, true);
  drive(20, 0.8, 0.5, 0.1, false);
  EXPECT_EQ(recent_.slip().slips.size(), 40U);
}

TEST_F(RecentDriveTest, SlipFromBeforeALongRestIsDropped) {
  drive(100, 0.8, 0.1);
  rest(params_.max_age_s - 1.0);
  drive(100, 0.8, 0.1);
  EXPECT_EQ(recent_.slip().slips.size(), 150U);
  rest(params_.max_age_s + 1.0);
  drive(20, 0.8, 0.1);
  EXPECT_EQ(recent_.slip().slips.size(), 20U);
}

/// The window of a slow rover is older than that, but no rest.
TEST_F(RecentDriveTest, SlowDrivingIsNoRest) {
  drive(3000, 0.04, 0.1);
  EXPECT_GT(recent_.slip().times_s.back(), 2.0 * params_.max_age_s);
}

TEST_F(RecentDriveTest, CruisingSpeedIsWithoutStartsAndStops) {
  drive(100, 0.8, 0.0);
  drive(5, 0.2, 0.0);
  EXPECT_NEAR(recent_.cruisingSpeed(), 0.8, 1e-12);
}

TEST_F(RecentDriveTest, AttitudesArePlayedToAndFro) {
  drive(200, 0.8, 0.1);
  EXPECT_EQ(numberOf(recent_.attitude(0)), 200);
  EXPECT_EQ(numberOf(recent_.attitude(50)), 150);
  EXPECT_EQ(numberOf(recent_.attitude(149)), 51);
  EXPECT_EQ(numberOf(recent_.attitude(159)), 61);
  EXPECT_EQ(numberOf(recent_.attitude(2 * 149)), 200);
}

TEST_F(RecentDriveTest, ForgetsEverything) {
  drive(100, 0.8, 0.1);
  recent_.reset();
  EXPECT_TRUE(recent_.slip().slips.empty());
  drive(1, 0.4, 0.1);
  EXPECT_NEAR(recent_.cruisingSpeed(), 0.36, 1e-12);
  EXPECT_EQ(numberOf(recent_.attitude(20)), 101);
}

}  // namespace
}  // namespace slipnav
