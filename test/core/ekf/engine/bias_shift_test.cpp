/// Vibration shifts the bias of an accelerometer as soon as the rover moves, after a rest that taught it precisely.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "recorded_drive.h"

namespace slipnav::test {
namespace {

constexpr double kShift_mps2 = 0.05;
constexpr double kMoving_mps = 0.01;

Config smallSensor() {
  Config config = driveConfig(40.0);
  config.simulator.terrain = "paved";
  config.simulator.drive.initial_rest_s = 20.0;
  config.imu.noise.accel_bias_std_ug = 10000.0;
  return config;
}

std::vector<DriveSample> withShift(std::vector<DriveSample> samples) {
  bool moves = false;
  for (DriveSample& sample : samples) {
    if (sample.is_imu) {
      sample.imu.f_ib_b.z() += moves ? kShift_mps2 : 0.0;
    } else {
      moves = sample.wheels.largest_speed_mps > kMoving_mps;
    }
  }
  return samples;
}

/// Otherwise the vertical speed sinks for many seconds, while the bias is believed to be known.
TEST(BiasShift, IsNotTakenForHeight) {
  const Config config = smallSensor();
  const RecordedDrive drive = recordDrive(config);
  const LoggedEstimate calm = runNavigator(config, drive.initial, drive.samples).back();
  const LoggedEstimate shifted = runNavigator(config, drive.initial, withShift(drive.samples)).back();
  const double off_m = shifted.estimate.nav.position.height_m - calm.estimate.nav.position.height_m;
  EXPECT_LT(std::abs(off_m), 3.0 * std::sqrt(shifted.P(kPosition + 2, kPosition + 2))) << off_m;
}

}  // namespace
}  // namespace slipnav::test
