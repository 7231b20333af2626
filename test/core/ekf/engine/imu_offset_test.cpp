/// The IMU is not where it is configured to be, or the vehicle does not turn about the middle of its wheels.

#include <gtest/gtest.h>

#include <cmath>

#include "recorded_drive.h"

namespace slipnav::test {
namespace {

constexpr double kAhead_m = 0.3;
constexpr double kRight_m = -0.15;

Config turningDrive() {
  Config config = driveConfig(60.0);
  config.simulator.drive.route = "circle";
  config.simulator.drive.circle_radius_m = 2.0;
  return config;
}

LoggedEstimate atTheEnd(const Config& config) {
  const RecordedDrive drive = recordDrive(config);
  return runNavigator(config, drive.initial, drive.samples).back();
}

TEST(ImuOffset, IsFoundInTurns) {
  Config config = turningDrive();
  config.simulator.imu.lever_arm_x_m = kAhead_m;
  config.simulator.imu.lever_arm_y_m = kRight_m;
  const LoggedEstimate last = atTheEnd(config);
  const Vector3& found_b = last.estimate.nav.imu_offset_b;
  for (int axis = 0; axis < 2; ++axis) {
    const double std_m = std::sqrt(last.P(kImuOffset + axis, kImuOffset + axis));
    EXPECT_LT(std_m, 0.07) << axis;
    EXPECT_NEAR(found_b(axis), axis == 0 ? kAhead_m : kRight_m, 3.0 * std_m) << axis;
  }
  EXPECT_EQ(found_b.z(), 0.0);
}

/// For IMU and wheels, an IMU behind the point about which the vehicle turns.
TEST(ImuOffset, IsThatOfATurningPointAhead) {
  Config config = turningDrive();
  config.simulator.terrain = "paved";
  config.simulator.ground.turning_point_m = kAhead_m;
  config.simulator.ground.turning_point_std_m = 0.05;
  const LoggedEstimate last = atTheEnd(config);
  const double std_m = std::sqrt(last.P(kImuOffset, kImuOffset));
  EXPECT_LT(std_m, 0.07);
  EXPECT_NEAR(last.estimate.nav.imu_offset_b.x(), -kAhead_m, 3.0 * std_m);
}

/// An exact mounting stays one.
TEST(ImuOffset, OfAnExactMountingIsNone) {
  const LoggedEstimate last = atTheEnd(turningDrive());
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(last.estimate.nav.imu_offset_b(axis), 0.0, 0.07) << axis;
  }
}

/// The noise of the gyros at rest is no turn.
TEST(ImuOffset, IsNotLearnedAtRest) {
  Config config = driveConfig(5.0);
  config.simulator.drive.initial_rest_s = 60.0;
  const RecordedDrive drive = recordDrive(config);
  const EstimateLog log = runNavigator(config, drive.initial, drive.samples);
  const LoggedEstimate& before = log.front();
  const LoggedEstimate& after = log[log.size() / 2];
  ASSERT_TRUE(after.estimate.stationary);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_GT(after.P(kImuOffset + axis, kImuOffset + axis), 0.8 * before.P(kImuOffset + axis, kImuOffset + axis));
  }
}

}  // namespace
}  // namespace slipnav::test
