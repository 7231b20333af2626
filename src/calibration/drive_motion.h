#pragma once
/// The smoothed drive over the wheel intervals: what the wheels are compared with.

#include <vector>

#include "calibration/aided_smoother.h"

namespace slipnav {

/// Means over one wheel interval in which the rover moves.
struct MotionSample {
  Nanoseconds end = 0;
  double duration_s = 0.0;
  double travel_m = 0.0;                      ///< of the wheels since the start of the drive, as configured
  Vector3 v_eb_b = Vector3::Zero();           ///< of base_link, in the axes of the IMU's configured mounting [m/s]
  Vector3 omega_eb_b = Vector3::Zero();       ///< [rad/s]
  Vector3 tilt_variance_b = Vector3::Zero();  ///< of the smoothed attitude about the same axes [rad²]
  Matrix3 position_covariance_n = Matrix3::Zero();  ///< of the smoothed position [m²]
  Vector3 forward_n = Vector3::Zero();              ///< direction the rover points
  double cross_slope = 0.0;                         ///< sine of the angle by which its right side is lower
  WheelMotion wheels;
};

/// Samples of a smoothed drive in order, without those at rest and those after a gap of the wheels.
std::vector<MotionSample> driveMotion(const Planet& planet, const Config& config, const CalibrationDrive& drive,
                                      const std::vector<TimedInterval>& intervals, const SmoothedDrive& smoothed);

}  // namespace slipnav
