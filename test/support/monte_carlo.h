#pragma once
/// Simulated drives through the navigation, with what is needed to judge its covariance.

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "config/config.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav::test {

/// Squared normalized errors at one epoch, three degrees of freedom each.
struct Nees {
  double attitude = 0.0;
  double velocity = 0.0;
  double position = 0.0;
};

struct DriveResult {
  std::vector<Nees> by_minute;  ///< at 60 s, 120 s, … after the initialization
  std::array<ComponentStatus, kComponents> components;
  double enu_error_pct = 0.0;
  double final_error_pct = 0.0;  ///< horizontal
  double distance_m = 0.0;
  double coverage_3sigma_pct = 0.0;
  ErrorVector final_error = ErrorVector::Zero();
  ErrorVector final_sigma = ErrorVector::Zero();
};

/// What happens to the sensors during a drive.
struct Disturbance {
  double begin_s = 0.0;       ///< after the initialization
  double imu_gap_s = 0.0;     ///< the IMU is silent for so long
  double wheel_gap_s = 0.0;   ///< the wheels are silent for so long
  double clock_jump_s = 0.0;  ///< all stamps are later by this from then on
};

/// One drive of config.simulator under the policy; truth is the simulator's own state.
DriveResult runDrive(const Config& config, const std::string& policy, const Disturbance& disturbance = {});

/// Drives 1 to `count`, two at a time.
std::vector<DriveResult> runDrives(int count, const std::function<DriveResult(int drive)>& run);

}  // namespace slipnav::test
