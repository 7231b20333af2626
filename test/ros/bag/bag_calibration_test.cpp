#include "ros/bag/bag_calibration.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "ros/simulated_bag.h"

namespace slipnav {
namespace {

/// Radii a percent larger than configured, the IMU on its side.
Config driveConfig() {
  Config config;
  config.simulator.terrain = "paved";
  config.simulator.vehicle.wheel_radius_m = 1.01 * config.wheels[0].radius_m;
  config.simulator.vehicle.common_radius_error = 0.0;
  config.simulator.vehicle.wheel_radius_error = 0.0;
  config.imu.mount.roll_deg = 90.0;
  return config;
}

class BagCalibrationTest : public testing::Test {
 protected:
  BagCalibrationTest() { test::writeShortDrive(bag_.path(), config_); }

  void expectRadii(const std::string& truth) const {
    const BagCalibration calibration = calibrateBag(bag_.path(), config_, truth, {});
    ASSERT_TRUE(calibration.result.left_radius_ratio);
    EXPECT_NEAR(calibration.result.left_radius_ratio->value, 1.01, 0.003);
    EXPECT_NEAR(calibration.result.right_radius_ratio->value, 1.01, 0.003);
  }

  Config config_ = driveConfig();
  test::TemporaryBag bag_;
};

TEST_F(BagCalibrationTest, fixesAreTruth) { expectRadii(""); }

TEST_F(BagCalibrationTest, posesAreTruthAsWell) { expectRadii(config_.topics.truth_odometry); }

TEST_F(BagCalibrationTest, fixesForTheStartAreNotNeeded) {
  config_.topics.gps_fix = "no/fixes";
  config_.filter.updates.clear();
  expectRadii("");
}

TEST_F(BagCalibrationTest, aRecordingWithoutTruthIsNamed) {
  config_.topics.truth_fix = "no/fixes";
  config_.topics.truth_odometry = "no/odometry";
  try {
    calibrateBag(bag_.path(), config_, "", {});
    FAIL() << "a recording without truth was calibrated";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), bag_.path() +
                                ": has no truth; calibration needs topic 'no/fixes', another one by --truth, " +
                                "or an RTKLIB file");
  }
}

TEST_F(BagCalibrationTest, whatIsWrongWithTheDriveComesWithItsName) {
  try {
    calibrateBag(bag_.path(), config_, "", {0.0, 6.0});  // it rests for longer
    FAIL() << "a rest was calibrated";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).rfind(bag_.path() + ": ", 0), 0U) << error.what();
  }
}

}  // namespace
}  // namespace slipnav
