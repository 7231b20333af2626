#pragma once
/// How the IMU sits in the vehicle: where its smoothed axes point against the course over ground.

#include <vector>

#include "calibration/calibration.h"

namespace slipnav {

/// Fills in mounting angles and turn centre. Reasons for what cannot be told go to `not_observable`.
void calibrateMount(const Config& config, const std::vector<MotionSample>& samples, CalibrationResult& result);

}  // namespace slipnav
