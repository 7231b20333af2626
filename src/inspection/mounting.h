#pragma once
/// Orientation of the IMU in the vehicle, from its measurements while the vehicle drives. See doc/check.md.

#include "core/sensors/imu_mount.h"
#include "inspection/motion_table.h"

namespace slipnav {

/// Estimates with their standard deviations; directions are unit vectors in the sensor's own axes.
struct Mounting {
  Vector3 up = Vector3::UnitZ();  ///< of the mean specific force

  bool has_forward = false;
  Vector3 forward = Vector3::UnitX();
  double forward_std_rad = 0.0;
  double force_gain = 0.0;  ///< specific force over the wheels' acceleration; 1 if the wheels are in m/s
  double force_gain_std = 0.0;
  double force_correlation = 0.0;  ///< where it is low, wheel slip lowers the gain
  /// Lateral force over speed times heading rate, divided by force_gain; 1 if the gyros are in rad/s.
  double centripetal_ratio = 0.0;
  double centripetal_std = 0.0;
  std::size_t batches_forward = 0;             ///< in which force and wheels clearly agree
  std::size_t batches_backward = 0;            ///< in which they clearly contradict
  std::size_t batches_certainly_forward = 0;   ///< in which hardly anything but the motion shows in the force
  std::size_t batches_certainly_backward = 0;  ///< likewise, with the opposite sign

  bool has_turn = false;
  /// The wheels' turn over the heading rate by the gyros (about up, positive left): the effective track if the turn
  /// is a difference of speeds, about 1 if it is a rate. The gyros are treated as exact: wheels slip.
  double turn_per_rate = 0.0;
  double turn_per_rate_std = 0.0;
  Vector3 turn_axis = Vector3::UnitZ();  ///< about which the gyros turn when the wheels turn left
  double turn_correlation = 0.0;

  Matrix3 nearest = Matrix3::Identity();  ///< of the 24 quarter turns, sensor to forward-left-up
  double left_over_rad = 0.0;             ///< from the nearest to the estimate
  bool is_sure = false;                   ///< no other quarter turn is within three standard deviations
};

Mounting estimateMounting(const MotionTable& table, const RestPicture& rest);

/// The 24 rotations that take axes to axes.
std::vector<Matrix3> quarterTurns();

/// Angles of a rotation from the sensor to forward-left-up, in the form of imu.mount; position zero.
MountParams toMountParams(const Matrix3& C_sensor_to_flu);

/// The inverse of toMountParams().
Matrix3 toRotation(const MountParams& mount);

/// "x forward, y left, z up": where the sensor's axes point.
std::string axesText(const Matrix3& C_sensor_to_flu);

}  // namespace slipnav
