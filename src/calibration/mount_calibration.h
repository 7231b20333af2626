#pragma once
/// Orientation of the IMU in the vehicle: its smoothed axes against the course over ground.

#include <vector>

#include "calibration/calibration.h"

namespace slipnav {

/// Fills in mounting angles and turn center. Reasons for what cannot be determined go to `not_observable`.
void calibrateMount(const Config& config, const std::vector<MotionSample>& samples, CalibrationResult& result);

}  // namespace slipnav
