#pragma once
/// A short simulated drive kept in memory, to be fed to the navigation in any order.

#include <vector>

#include "config/config.h"
#include "core/navigation/navigator.h"
#include "simulation/truth_state.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav::test {

/// One sample of either kind.
struct DriveSample {
  bool is_imu = false;
  ImuSample imu;
  WheelMotion wheels;
  Nanoseconds stamp() const { return is_imu ? imu.stamp : wheels.stamp; }
};

struct RecordedDrive {
  InitialState initial;              ///< the truth at the start, with small uncertainties
  std::vector<DriveSample> samples;  ///< in order of their stamps
  NavigationState end;               ///< the truth at the last IMU sample
};

/// Configuration of a drive: rest, straight, about `distance_m` of route on rough ground, rest.
Config driveConfig(double distance_m);

/// Runs the simulator without stops.
RecordedDrive recordDrive(const Config& config);

/// Everything a filter says about the end of a step.
struct LoggedEstimate {
  Estimate estimate;
  ErrorCovariance P;
};
using EstimateLog = std::vector<LoggedEstimate>;

/// Runs the samples in the order given, and completes up to the last one.
EstimateLog runNavigator(const Config& config, const InitialState& initial, const std::vector<DriveSample>& samples);

/// Whether two runs said the same about every step, bit for bit.
bool sameEstimates(const EstimateLog& a, const EstimateLog& b);

}  // namespace slipnav::test
