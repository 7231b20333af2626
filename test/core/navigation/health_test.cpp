#include "slipnav/core/navigation/health.h"

#include <gtest/gtest.h>

#include "recorded_drive.h"

namespace slipnav::test {
namespace {

FilterSetup setup() { return Config().navigation().filter; }

TEST(HealthMonitor, NamesWhatIsWrongWithTheImu) {
  HealthMonitor health(setup());
  health.noteImu(10 * kSecond, ImuVerdict::kAccepted);
  EXPECT_TRUE(health.alarms().empty());
  health.noteImu(11 * kSecond, ImuVerdict::kAfterGap);
  health.noteImu(12 * kSecond, ImuVerdict::kStuck);
  health.noteImu(13 * kSecond, ImuVerdict::kStuck);
  ASSERT_EQ(health.alarms().size(), 2U);
  const Alarm& stuck = health.alarms().at("IMU sample with a stuck axis");
  EXPECT_EQ(stuck.first, 12 * kSecond);
  EXPECT_EQ(stuck.last, 13 * kSecond);
  EXPECT_EQ(stuck.count, 2U);
}

TEST(HealthMonitor, SilentAndContradictingWheelsAreNoticed) {
  const Config config = driveConfig(6.0);
  const RecordedDrive drive = recordDrive(config);
  const NavigationSetup setup = config.navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive.initial);
  HealthMonitor health(setup.filter);
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  const Nanoseconds silent_from = drive.samples.back().stamp() - 3 * kSecond;
  for (DriveSample sample : drive.samples) {
    if (sample.is_imu) {
      navigator.push(sample.imu, ignore);
    } else if (sample.stamp() < silent_from) {
      sample.wheels.circumferential_mps[2] = 0.0;
      health.noteWheels(sample.wheels, navigator.push(sample.wheels, ignore));
    }
    health.noteFilter(navigator.filter());
  }
  EXPECT_EQ(health.alarms().count("back_left_wheel contradicts the other wheels"), 1U);
  EXPECT_EQ(health.alarms().count("front_left_wheel contradicts the other wheels"), 0U);
  ASSERT_EQ(health.alarms().count("wheels silent"), 1U);
  EXPECT_GE(health.alarms().at("wheels silent").first, silent_from);
}

/// A measurement that was rejected for long and is no longer made contradicts nothing.
TEST(HealthMonitor, WhatIsNotMeasuredContradictsNothing) {
  const Config config = driveConfig(6.0);
  const RecordedDrive drive = recordDrive(config);
  const NavigationSetup setup = config.navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive.initial);
  HealthMonitor health(setup.filter);
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  const Nanoseconds wrong_from = drive.samples.back().stamp() - 9 * kSecond;  // driving
  const Nanoseconds silent_from = drive.samples.back().stamp() - 7 * kSecond;
  for (DriveSample sample : drive.samples) {
    if (sample.is_imu) {
      navigator.push(sample.imu, ignore);
    } else if (sample.stamp() < silent_from) {
      sample.wheels.motion.yaw_rate_radps += sample.stamp() > wrong_from ? 3.0 : 0.0;
      navigator.push(sample.wheels, ignore);
    }
    health.noteFilter(navigator.filter());
  }
  ASSERT_EQ(health.alarms().count("yaw_rate contradicts"), 1U);
  EXPECT_LT(health.alarms().at("yaw_rate contradicts").last, silent_from + kSecond);
}

}  // namespace
}  // namespace slipnav::test
