#pragma once
/// A recorded drive as input of the calibration.

#include <vector>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/models/gnss_fix.h"
#include "slipnav/core/ins/strapdown.h"
#include "slipnav/core/sensors/imu_screen.h"

namespace slipnav {

/// The samples of all sensors and the truth, each in order of stamp.
struct CalibrationDrive {
  std::vector<ImuSample> imu;  ///< in the axes of the configured mounting
  std::vector<WheelMotion> wheels;
  std::vector<PositionFix> truth;  ///< of the truth point; zero variance if unknown
};

/// One IMU interval, biases included.
struct TimedInterval {
  Nanoseconds start = 0;
  Nanoseconds end = 0;
  ImuInterval mean;
};

/// Sorts each sensor's samples by stamp and drops repeated ones.
void sortByStamp(CalibrationDrive& drive);

/// Usable IMU samples as consecutive intervals, see ImuScreen. Throws std::invalid_argument for a gap that cannot be
/// bridged: the rover's motion in it is not known.
std::vector<TimedInterval> imuIntervals(const std::vector<ImuSample>& samples, const ImuInputParams& params);

}  // namespace slipnav
