#pragma once
/// The true state in a simulated drive, at one instant.

#include <array>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/base/types.h"
#include "slipnav/core/earth/planet.h"

namespace slipnav::sim {

/// Order of wheels everywhere: front left, front right, back left, back right.
inline constexpr std::size_t kWheelCount = 4;
using PerWheel = std::array<double, kWheelCount>;
/// Angle of each wheel that has an encoder, in the order of WheelSample.
using EncoderAngles = std::array<double, kMaxWheels>;

/// Pose and motion are those of base_link, the center of the four wheel centers. Body axes: forward, right, down.
struct TruthState {
  Nanoseconds stamp = 0;
  Geodetic position;
  Vector3 position_enu_m = Vector3::Zero();      ///< in the tangent plane at the start pose
  Quaternion q_b_to_n = Quaternion::Identity();  ///< attitude in north-east-down, with vibration
  Vector3 v_eb_n = Vector3::Zero();              ///< velocity over the planet, with vibration [m/s]
  double heading_rad = 0.0;                      ///< from north towards east, without vibration
  Vector3 v_eb_b = Vector3::Zero();              ///< velocity in body axes, without vibration [m/s]
  Vector3 omega_ib_b = Vector3::Zero();          ///< w.r.t. inertial space, without vibration [rad/s]
  Vector3 accel_bias_mps2 = Vector3::Zero();     ///< the sensor's own, in its axes [m/s²]
  Vector3 gyro_bias_radps = Vector3::Zero();     ///< the sensor's own, in its axes [rad/s]
  PerWheel wheel_rate_radps = {};                ///< positive forward
  PerWheel wheel_radius_m = {};                  ///< true, constant
  PerWheel slip = {};           ///< slip ratio with the true radius, in [−1, 1]; 0 if the wheel is at rest
  double slip_angle_rad = 0.0;  ///< atan2(v_y, v_x) at base_link; 0 at standstill
  bool standstill = true;       ///< nothing moves: the pose is exactly constant
  double distance_m = 0.0;      ///< path length of base_link since the start
};

}  // namespace slipnav::sim
