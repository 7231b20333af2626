#pragma once
/// Simulated drives for the calibration, with what is true about the rover.

#include <vector>

#include "calibration/calibration.h"
#include "simulation/truth_state.h"

namespace slipnav::test {

/// Effective over geometric track of the simulated rover on paved ground.
inline constexpr double kPavedScrub = 1.5;

/// Paved ground, radii wrong by percents and IMU turned by a quarter of a degree, signs by the seed.
Config calibrationConfig(int seed, double distance_m);

struct SimulatedCalibrationDrive {
  CalibrationDrive drive;
  std::vector<sim::TruthState> truth;  ///< at the stamp of each IMU sample
  double left_radius_ratio = 1.0;      ///< true over configured, mean of the side
  double right_radius_ratio = 1.0;
};

SimulatedCalibrationDrive simulateCalibrationDrive(const Config& config);

}  // namespace slipnav::test
