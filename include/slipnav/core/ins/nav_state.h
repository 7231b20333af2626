#pragma once
/// The total state carried by the inertial navigation, resolved in the local navigation frame (Groves 5.4).

#include "slipnav/core/base/types.h"
#include "slipnav/core/earth/planet.h"

namespace slipnav {

/// Attitude, velocity and position of the IMU where it is configured to be, and what is known of the IMU's errors, at
/// one instant.
struct NavigationState {
  Nanoseconds stamp = 0;
  Quaternion q_b_to_n = Quaternion::Identity();  ///< body (forward-right-down) to local north-east-down
  Vector3 v_eb_n = Vector3::Zero();              ///< velocity w.r.t. the planet, north-east-down [m/s]
  Geodetic position;                             ///< of the IMU
  Vector3 accel_bias_b = Vector3::Zero();        ///< subtracted from the measured specific force [m/s²]
  Vector3 gyro_bias_b = Vector3::Zero();         ///< subtracted from the measured angular rate [rad/s]
  Vector3 imu_offset_b = Vector3::Zero();        ///< where the IMU really is, from where it is configured to be [m]
};

/// True if no number of the state is NaN or infinite.
bool isFinite(const NavigationState& state);

}  // namespace slipnav
