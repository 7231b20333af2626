#pragma once
/// Wheel radii, scrub factor and IMU mounting from a drive with truth positions. See doc/calibration.md.

#include <optional>
#include <string>
#include <vector>

#include "calibration/drive_motion.h"

namespace slipnav {

/// An estimate and its standard deviation.
struct Calibrated {
  double value = 0.0;
  double std = 0.0;
};

/// What could be estimated, and for each quantity that could not, a line in `not_observable`.
struct CalibrationResult {
  /// True over configured radius, of the wheels left and right of the middle; equal if sides cannot be separated.
  /// For a recording with the robot's own odometry and no wheel rates: ground speed over reported speed.
  std::optional<Calibrated> left_radius_ratio;
  std::optional<Calibrated> right_radius_ratio;
  bool has_wheel_rates = true;
  bool sides_differ = false;               ///< the two were estimated separately
  std::optional<Calibrated> scrub_factor;  ///< effective over configured track
  std::optional<double> track_m;           ///< configured, between the mean left and the mean right wheel
  /// Angles by which the axes of the configured mounting are turned in the vehicle: pitch positive nose up, yaw
  /// positive to the right (axes forward-right-down) [rad].
  std::optional<Calibrated> mount_pitch_rad;
  std::optional<Calibrated> mount_yaw_rad;
  std::optional<Calibrated> slip;           ///< mean slip of the wheels beyond the firm ground, on these radii
  std::optional<Calibrated> turn_center_m;  ///< ahead of base_link: the point that does not move sideways in turns
  std::vector<std::string> not_observable;  ///< quantity and reason
  std::vector<std::string> warnings;
  double distance_m = 0.0;        ///< driven in the motion used
  double turned_rad = 0.0;        ///< sum of all turns, left and right
  double heading_std_rad = 0.0;   ///< mean 1σ of the smoothed heading while moving
  std::size_t fixes = 0;          ///< truth positions used
  double fix_noise_factor = 1.0;  ///< on the 1σ that the truth claims, from comparison with the IMU
};

/// Throws std::invalid_argument that says what is missing if nothing can be estimated.
CalibrationResult calibrate(const Config& config, CalibrationDrive drive);

/// The configured wheels with calibrated radii.
std::vector<WheelParams> calibratedWheels(const Config& config, const CalibrationResult& result);

/// The configured mounting of the IMU turned by the calibrated angles.
MountParams calibratedMount(const Config& config, const CalibrationResult& result);

}  // namespace slipnav
