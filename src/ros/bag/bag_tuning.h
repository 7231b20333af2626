#pragma once
/// Recordings for a tuning.

#include <string>

#include "tuning/drive_likelihood.h"

namespace slipnav {

/// A recording in memory, without its truth. Throws like BagReader.
TuningDrive readTuningDrive(const std::string& path, const Config& config);

}  // namespace slipnav
