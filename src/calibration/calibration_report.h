#pragma once
/// A calibration as text, and as configuration.

#include <string>

#include "calibration/calibration.h"

namespace slipnav {

/// Table of all quantities: configured, estimated, 1σ; then what could not be estimated and why, then warnings.
std::string calibrationTable(const Config& config, const CalibrationResult& result);

/// What to change in the configuration, with each 1σ as a comment: wheels, wheel.scrub_factor, imu.mount; omits what
/// was not estimated. A file for --config.
std::string calibrationYaml(const Config& config, const CalibrationResult& result);

}  // namespace slipnav
