#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "simulated_calibration.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

using test::calibrationConfig;
using test::simulateCalibrationDrive;
using test::SimulatedCalibrationDrive;

constexpr double kLargestRadiusError = 0.003;

double sigmas(const std::optional<Calibrated>& found, double truth) {
  return found ? std::abs(found->value - truth) / found->std : std::numeric_limits<double>::infinity();
}

class SimulatedCalibration : public testing::TestWithParam<int> {};

TEST_P(SimulatedCalibration, isRightWithinAnUncertaintyOfUse) {
  const Config config = calibrationConfig(GetParam(), 300.0);
  const SimulatedCalibrationDrive simulated = simulateCalibrationDrive(config);
  const CalibrationResult result = calibrate(config, simulated.drive);
  EXPECT_LT(sigmas(result.left_radius_ratio, simulated.left_radius_ratio), 3.0);
  EXPECT_LT(sigmas(result.right_radius_ratio, simulated.right_radius_ratio), 3.0);
  EXPECT_NEAR(result.left_radius_ratio->value / simulated.left_radius_ratio, 1.0, kLargestRadiusError);
  EXPECT_NEAR(result.right_radius_ratio->value / simulated.right_radius_ratio, 1.0, kLargestRadiusError);
  EXPECT_LT(sigmas(result.scrub_factor, test::kPavedScrub), 3.0);
  EXPECT_LT(sigmas(result.mount_yaw_rad, degToRad(config.simulator.imu.misalignment_yaw_deg)), 3.0);
  EXPECT_LT(sigmas(result.mount_pitch_rad, degToRad(config.simulator.imu.misalignment_pitch_deg)), 3.0);
  EXPECT_TRUE(result.warnings.empty());
  // an uncertainty that is too large to be of use would pass all of the above
  EXPECT_LT(result.left_radius_ratio->std, 0.001);
  EXPECT_LT(result.scrub_factor->std, 0.03);
  EXPECT_LT(radToDeg(result.mount_yaw_rad->std), 0.12);
  EXPECT_LT(radToDeg(result.mount_pitch_rad->std), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SimulatedCalibration, testing::Values(1, 2, 3));

TEST(CalibrationTest, leverArmsOfImuAndTruthCount) {
  Config config = calibrationConfig(5, 200.0);
  config.simulator.imu.lever_arm_x_m = 0.4;
  config.simulator.imu.lever_arm_y_m = -0.2;
  config.imu.mount.x_m = 0.4;
  config.imu.mount.y_m = 0.2;  // left, where the simulator counts to the right
  config.simulator.truth.antenna_x_m = -0.5;
  config.simulator.truth.antenna_z_m = -1.0;
  config.truth_mount.x_m = -0.5;
  config.truth_mount.z_m = 1.0;
  const SimulatedCalibrationDrive simulated = simulateCalibrationDrive(config);
  const CalibrationResult result = calibrate(config, simulated.drive);
  EXPECT_LT(sigmas(result.left_radius_ratio, simulated.left_radius_ratio), 3.0);
  EXPECT_LT(sigmas(result.scrub_factor, test::kPavedScrub), 3.0);
  EXPECT_LT(sigmas(result.mount_yaw_rad, degToRad(config.simulator.imu.misalignment_yaw_deg)), 3.0);
  EXPECT_LT(sigmas(result.mount_pitch_rad, degToRad(config.simulator.imu.misalignment_pitch_deg)), 3.0);
  EXPECT_LT(std::abs(result.turn_center_m->value), 0.02);
}

/// On soft ground a rover drives crabwise down a slope, and to one side for meters; both look like a turned IMU.
TEST(CalibrationTest, theYawAllowsForSideSlip) {
  for (const int seed : {7, 11}) {
    Config config = calibrationConfig(seed, 300.0);
    config.simulator.terrain = "rough";
    const CalibrationResult result = calibrate(config, simulateCalibrationDrive(config).drive);
    EXPECT_LT(sigmas(result.mount_yaw_rad, degToRad(config.simulator.imu.misalignment_yaw_deg)), 3.0) << seed;
    EXPECT_LT(radToDeg(result.mount_yaw_rad->std), 0.4);
  }
}

TEST(CalibrationTest, truthThatIsNoisierThanItSaysIsFoundOut) {
  Config config = calibrationConfig(4, 150.0);
  config.simulator.truth.horizontal_noise_m = 0.03;
  config.simulator.truth.vertical_noise_m = 0.06;
  SimulatedCalibrationDrive simulated = simulateCalibrationDrive(config);
  for (PositionFix& fix : simulated.drive.truth) {
    fix.variance_ned_m2 /= 9.0;
  }
  const CalibrationResult result = calibrate(config, simulated.drive);
  EXPECT_NEAR(result.fix_noise_factor, 3.0, 0.5);
  EXPECT_LT(sigmas(result.left_radius_ratio, simulated.left_radius_ratio), 3.0);
}

TEST(CalibrationTest, theMountingThatComesOutUndoesTheTurn) {
  Config config;
  config.imu.mount.roll_deg = 180.0;
  config.imu.mount.yaw_deg = 30.0;
  CalibrationResult result;
  result.mount_pitch_rad = Calibrated{0.02, 0.001};
  result.mount_yaw_rad = Calibrated{-0.03, 0.001};
  const Vector3 v_b(0.3, -1.2, 2.0);
  // what the sensor says when its axes are turned in the vehicle against the configured ones
  const Vector3 v_turned = q_b_to_n_fromEuler(0.0, 0.02, -0.03).conjugate() * v_b;
  const Vector3 v_sensor = ImuMount(config.imu.mount).toSensor(v_turned);
  const ImuSample sample = ImuMount(calibratedMount(config, result)).toBody(0, v_sensor, v_sensor);
  EXPECT_NEAR((sample.f_ib_b - v_b).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace slipnav
