#pragma once
/// Radii, scrub factor and slip: wheel speeds against the smoothed motion.

#include <vector>

#include "calibration/calibration.h"

namespace slipnav {

/// Fills in what the wheels determine. Reasons for the rest go to `not_observable`.
/// @param samples of a drive that has moved
void calibrateWheels(const Config& config, const std::vector<MotionSample>& samples, CalibrationResult& result);

}  // namespace slipnav
