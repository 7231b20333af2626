/// Drives that tell less than all, or nothing.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "simulated_calibration.h"

namespace slipnav {
namespace {

using test::calibrationConfig;
using test::simulateCalibrationDrive;
using test::SimulatedCalibrationDrive;

/// What calibrate() throws, "" when it does not.
std::string complaint(const Config& config, const CalibrationDrive& drive) {
  try {
    calibrate(config, drive);
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

bool isNotObservable(const CalibrationResult& result, const std::string& quantity) {
  return std::any_of(result.not_observable.begin(), result.not_observable.end(),
                     [&quantity](const std::string& line) { return line.rfind(quantity, 0) == 0; });
}

/// The straight drive of the initialization and hardly more.
const Config& straightConfig() {
  static const Config config = calibrationConfig(1, 1.0);
  return config;
}

const SimulatedCalibrationDrive& straightDrive() {
  static const SimulatedCalibrationDrive drive = simulateCalibrationDrive(straightConfig());
  return drive;
}

TEST(CalibrationInputTest, withoutTruthNothingCanBeSaid) {
  CalibrationDrive drive = straightDrive().drive;
  drive.truth.clear();
  EXPECT_EQ(complaint(straightConfig(), drive), "there are no truth positions");
}

TEST(CalibrationInputTest, truthOfAnotherDayIsNamed) {
  CalibrationDrive drive = straightDrive().drive;
  for (PositionFix& fix : drive.truth) {
    fix.stamp += fromSeconds(86400.0);
  }
  EXPECT_EQ(complaint(straightConfig(), drive), "truth positions and IMU samples have no time in common");
}

TEST(CalibrationInputTest, truthOfAnotherClockIsNamed) {
  const Config config = calibrationConfig(2, 60.0);
  CalibrationDrive drive = simulateCalibrationDrive(config).drive;
  for (PositionFix& fix : drive.truth) {
    fix.stamp += 18 * kSecond;
  }
  EXPECT_NE(complaint(config, drive).find("too late relative to the drive (18 s: GPS time instead of UTC?)"),
            std::string::npos)
      << complaint(config, drive);
}

TEST(CalibrationInputTest, wheelsInAnotherUnitAreRefused) {
  CalibrationDrive drive = straightDrive().drive;
  for (WheelMotion& wheels : drive.wheels) {  // revolutions per minute
    wheels.motion.forward_mps *= 30.0 / kPi;
    for (double& speed : wheels.circumferential_mps) {
      speed *= 30.0 / kPi;
    }
  }
  EXPECT_NE(complaint(straightConfig(), drive).find("times as far as the wheels say"), std::string::npos)
      << complaint(straightConfig(), drive);
}

TEST(CalibrationInputTest, withoutWheelsNothingCanBeSaid) {
  CalibrationDrive drive = straightDrive().drive;
  drive.wheels.clear();
  EXPECT_EQ(complaint(straightConfig(), drive), "there are no usable wheel samples");
}

TEST(CalibrationInputTest, aRoverThatStandsIsRefused) {
  CalibrationDrive drive = straightDrive().drive;
  const Nanoseconds end = drive.imu.front().stamp + fromSeconds(25.0);  // it starts after 30 s
  const auto later = [end](const auto& sample) { return sample.stamp > end; };
  drive.imu.erase(std::remove_if(drive.imu.begin(), drive.imu.end(), later), drive.imu.end());
  drive.wheels.erase(std::remove_if(drive.wheels.begin(), drive.wheels.end(), later), drive.wheels.end());
  drive.truth.erase(std::remove_if(drive.truth.begin(), drive.truth.end(), later), drive.truth.end());
  EXPECT_NE(complaint(straightConfig(), drive).find("too little motion"), std::string::npos);
}

TEST(CalibrationInputTest, aGapOfTheImuIsRefusedWithItsPlace) {
  CalibrationDrive drive = straightDrive().drive;
  drive.imu.erase(drive.imu.begin() + 500, drive.imu.begin() + 650);
  EXPECT_NE(complaint(straightConfig(), drive).find("the IMU is silent for 3"), std::string::npos);
}

TEST(CalibrationInputTest, aStraightDriveTellsRadiiButNotTheScrub) {
  const CalibrationResult result = calibrate(straightConfig(), straightDrive().drive);
  ASSERT_TRUE(result.left_radius_ratio);
  EXPECT_NEAR(result.left_radius_ratio->value / straightDrive().left_radius_ratio, 1.0, 0.003);
  EXPECT_NEAR(result.right_radius_ratio->value / straightDrive().right_radius_ratio, 1.0, 0.003);
  EXPECT_FALSE(result.scrub_factor);
  EXPECT_TRUE(isNotObservable(result, "scrub factor"));
  EXPECT_FALSE(result.turn_center_m);
}

TEST(CalibrationInputTest, rollIsNeverClaimed) {
  EXPECT_TRUE(isNotObservable(calibrate(straightConfig(), straightDrive().drive), "roll of the IMU"));
}

TEST(CalibrationInputTest, aSpeedAloneGivesOneScaleForAllWheels) {
  const Config config = calibrationConfig(2, 100.0);
  SimulatedCalibrationDrive simulated = simulateCalibrationDrive(config);
  for (WheelMotion& wheels : simulated.drive.wheels) {
    wheels = toWheelMotion(SpeedSample{wheels.stamp, wheels.motion.forward_mps});
  }
  const CalibrationResult result = calibrate(config, simulated.drive);
  ASSERT_TRUE(result.left_radius_ratio);
  EXPECT_FALSE(result.has_wheel_rates);
  EXPECT_FALSE(result.sides_differ);
  EXPECT_EQ(result.left_radius_ratio->value, result.right_radius_ratio->value);
  const double mean = 0.5 * (simulated.left_radius_ratio + simulated.right_radius_ratio);
  EXPECT_NEAR(result.left_radius_ratio->value / mean, 1.0, 0.003);
  EXPECT_TRUE(isNotObservable(result, "scrub factor"));
}

TEST(CalibrationInputTest, groundThatWasNotFirmIsNoticed) {
  const Config config = calibrationConfig(3, 200.0);
  SimulatedCalibrationDrive simulated = simulateCalibrationDrive(config);
  double travel_m = 0.0;
  for (WheelMotion& wheels : simulated.drive.wheels) {
    travel_m += 0.1 * wheels.largest_speed_mps;
    const double spin = travel_m < config.calibration.firm_distance_m ? 1.05 : 1.0;
    for (double& speed : wheels.circumferential_mps) {
      speed *= spin;
    }
  }
  EXPECT_EQ(calibrate(config, simulated.drive).warnings.size(), 1U);
}

}  // namespace
}  // namespace slipnav
