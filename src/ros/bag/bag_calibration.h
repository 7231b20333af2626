#pragma once
/// Calibration of a recording.

#include <string>

#include "calibration/calibration.h"
#include "ros/bag/bag_reader.h"

namespace slipnav {

/// The calibration of a recording, and the configuration it started from.
struct BagCalibration {
  Config config;  ///< as used, with the sensor poses from the recording
  CalibrationResult result;
};

/// @param truth topic or RTKLIB file (.pos) of the truth; "" for what the recording has, see BagReader
/// Throws std::invalid_argument that names the recording and what is missing.
BagCalibration calibrateBag(const std::string& path, const Config& config, const std::string& truth,
                            const BagRange& range);

}  // namespace slipnav
