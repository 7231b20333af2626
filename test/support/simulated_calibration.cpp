#include "simulated_calibration.h"

#include "evaluation/simulated_drive.h"

namespace slipnav::test {

Config calibrationConfig(int seed, double distance_m) {
  Config config;
  config.simulator.seed = seed;
  config.simulator.terrain = "paved";
  config.simulator.drive.distance_m = distance_m;
  config.simulator.vehicle.common_radius_error = 0.015;
  config.simulator.vehicle.wheel_radius_error = 0.006;
  config.simulator.imu.misalignment_yaw_deg = seed % 2 == 0 ? 0.25 : -0.25;
  config.simulator.imu.misalignment_pitch_deg = seed % 3 == 0 ? 0.25 : -0.25;
  return config;
}

SimulatedCalibrationDrive simulateCalibrationDrive(const Config& config) {
  SimulatedCalibrationDrive result;
  const WheelGeometry geometry = config.wheelGeometry();
  NeverStop policy;
  simulateDrive(config.simulator, Planet::byName(config.planet), policy,
                [&](const sim::Measurements& measurements, const sim::TruthState& truth) {
                  result.drive.imu.push_back(measurements.imu);
                  if (measurements.wheel) {
                    result.drive.wheels.push_back(toWheelMotion(geometry, *measurements.wheel));
                  }
                  if (measurements.truth) {
                    result.drive.truth.push_back(toPositionFix(*measurements.truth));
                  }
                  result.truth.push_back(truth);
                });
  const sim::PerWheel& radii_m = result.truth.back().wheel_radius_m;
  result.left_radius_ratio = 0.5 * (radii_m[0] + radii_m[2]) / config.wheels[0].radius_m;
  result.right_radius_ratio = 0.5 * (radii_m[1] + radii_m[3]) / config.wheels[1].radius_m;
  return result;
}

}  // namespace slipnav::test
