#include "slipnav/core/navigation/health.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

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

/// A short drive; what the monitor says when its wheel samples are changed, or lost, on their way.
class HealthOfADrive : public ::testing::Test {
 protected:
  /// @return false for a sample that is lost
  using Change = std::function<bool(WheelMotion& wheels)>;

  Alarms alarmsWith(const Change& change) const {
    const NavigationSetup setup = config_.navigation();
    Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
    navigator.initialize(drive_.initial);
    HealthMonitor health(setup.filter);
    const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
    for (DriveSample sample : drive_.samples) {
      if (sample.is_imu) {
        navigator.push(sample.imu, ignore);
      } else if (change(sample.wheels)) {
        health.noteWheels(sample.wheels, navigator.push(sample.wheels, ignore));
      }
      health.noteFilter(navigator.filter());
    }
    return health.alarms();
  }
  Nanoseconds beforeTheEnd(double duration_s) const { return drive_.samples.back().stamp() - fromSeconds(duration_s); }

  const Config config_ = driveConfig(6.0);
  const RecordedDrive drive_ = recordDrive(config_);
};

TEST_F(HealthOfADrive, SilentAndContradictingWheelsAreNoticed) {
  const Nanoseconds silent_from = beforeTheEnd(3.0);
  const Alarms alarms = alarmsWith([&](WheelMotion& wheels) {
    wheels.circumferential_mps[2] = 0.0;
    return wheels.stamp < silent_from;
  });
  EXPECT_EQ(alarms.count("back_left_wheel contradicts the other wheels"), 1U);
  EXPECT_EQ(alarms.count("front_left_wheel contradicts the other wheels"), 0U);
  ASSERT_EQ(alarms.count("wheels silent"), 1U);
  EXPECT_GE(alarms.at("wheels silent").first, silent_from);
}

/// A measurement that was rejected for long and is no longer made contradicts nothing.
TEST_F(HealthOfADrive, WhatIsNotMeasuredContradictsNothing) {
  const Nanoseconds wrong_from = beforeTheEnd(9.0);  // driving
  const Nanoseconds silent_from = beforeTheEnd(7.0);
  const Alarms alarms = alarmsWith([&](WheelMotion& wheels) {
    wheels.motion.yaw_rate_radps += wheels.stamp > wrong_from ? 3.0 : 0.0;
    return wheels.stamp < silent_from;
  });
  ASSERT_EQ(alarms.count("yaw_rate contradicts"), 1U);
  EXPECT_LT(alarms.at("yaw_rate contradicts").last, silent_from + kSecond);
}

TEST_F(HealthOfADrive, OfSoundWheelsSaysNothing) {
  EXPECT_TRUE(alarmsWith([](WheelMotion&) { return true; }).empty());
}

/// At the end of the drive, where the rover stands.
TEST_F(HealthOfADrive, WheelsThatTurnOnTheSpotAreNoticed) {
  const Nanoseconds stuck_from = beforeTheEnd(3.0);
  const Alarms alarms = alarmsWith([&](WheelMotion& wheels) {
    if (wheels.stamp > stuck_from) {
      wheels.circumferential_mps.fill(0.8);
      wheels.largest_speed_mps = wheels.motion.forward_mps = 0.8;
    }
    return true;
  });
  const std::string stuck = "stuck: the wheels turn but the rover does not move";
  ASSERT_EQ(alarms.count(stuck), 1U);
  EXPECT_GT(alarms.at(stuck).first, stuck_from);
}

TEST(HealthMonitor, ASizeIsSaidAgainOnceItHasGrownByAQuarter) {
  HealthMonitor health(setup());
  health.noteSized("scatter", 4.0, "ms", kSecond);
  health.noteSized("scatter", 5.0, "ms", 2 * kSecond);
  ASSERT_EQ(health.alarms().count("scatter 4 ms"), 1U);
  EXPECT_EQ(health.alarms().at("scatter 4 ms").count, 2U);
  health.noteSized("scatter", 5.25, "ms", 3 * kSecond);
  health.noteSized("scatter", 1.0, "ms", 4 * kSecond);
  ASSERT_EQ(health.alarms().size(), 1U);
  const Alarm& alarm = health.alarms().at("scatter 5.2 ms");
  EXPECT_EQ(alarm.first, kSecond);
  EXPECT_EQ(alarm.last, 4 * kSecond);
  EXPECT_EQ(alarm.count, 4U);
}

TEST(HealthMonitor, CountsWhatIsWrongWithStamps) {
  HealthMonitor health(setup());
  StampFaults faults;
  health.noteStamps(faults, kSecond);
  EXPECT_TRUE(health.alarms().empty());
  faults.equal = 2;
  faults.lost = 3;
  faults.usual_interval_s = 0.01;
  faults.scatter_s = 0.002;
  for (int i = 2; i < 5; ++i) {
    health.noteStamps(faults, i * kSecond);
  }
  EXPECT_EQ(health.alarms().at("IMU stamps equal").count, 2U);
  EXPECT_EQ(health.alarms().at("IMU samples lost").count, 3U);
  EXPECT_EQ(health.alarms().at("IMU stamps scatter by 2 ms").count, 1U) << "the same scatter is no other one";
  health.noteSetBack(5.04, 9 * kSecond);
  EXPECT_EQ(health.alarms().count("clock set back by 5 s"), 1U);
}

TEST(HealthMonitor, NamesWheelsThatHaveNoName) {
  FilterSetup nameless = setup();
  nameless.wheels[2].name.clear();
  HealthMonitor health(nameless);
  WheelMotion wheels;
  wheels.stamp = 7 * kSecond;
  health.noteWheels(wheels, false);
  health.noteWheels(wheels, true);
  EXPECT_EQ(health.alarms().at("wheel sample repeated or too late").count, 1U);
}

}  // namespace
}  // namespace slipnav::test
