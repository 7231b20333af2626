#pragma once
/// Starting point of the calibration's smoother: leveled by the specific force, heading from the shape of the track.

#include "calibration/calibration_drive.h"
#include "config/config.h"
#include "slipnav/core/ins/nav_state.h"

namespace slipnav {

/// State of the IMU at the start of the first interval that truth covers, good to a few degrees. The heading is the one
/// by which dead reckoning with wheels and gyro fits the truth over the first `initialization.drive_distance_m`.
/// @param drive sorted, see sortByStamp()
/// Throws std::invalid_argument that says what is missing.
NavigationState guessStart(const Planet& planet, const Config& config, const CalibrationDrive& drive,
                           const std::vector<TimedInterval>& intervals);

}  // namespace slipnav
