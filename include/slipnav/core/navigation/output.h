#pragma once
/// The estimate in the axes that users see (REP-103, REP-105): base_link forward-left-up, in an east-north-up frame.

#include "slipnav/core/earth/local_frame.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

using Covariance6 = Eigen::Matrix<double, 6, 6>;

/// Pose and twist of base_link as in nav_msgs/Odometry.
struct Output {
  Nanoseconds stamp = 0;
  Vector3 position_enu_m = Vector3::Zero();
  Quaternion q_flu_to_enu = Quaternion::Identity();
  Vector3 velocity_flu_mps = Vector3::Zero();          ///< over ground, base_link axes
  Vector3 angular_rate_flu_radps = Vector3::Zero();    ///< w.r.t. the planet, base_link axes
  Covariance6 pose_covariance = Covariance6::Zero();   ///< position [m], then rotation about fixed ENU axes [rad]
  Covariance6 twist_covariance = Covariance6::Zero();  ///< velocity, then angular rate, base_link axes
};

/// The only place where core axes are converted to those of messages. Immutable.
class OutputMaker {
 public:
  /// @param lever_imu_to_base_b from the IMU to base_link, body axes [m]
  /// @param gyro_noise_density of the angular rate [rad²/s]
  OutputMaker(const Planet& planet, const Geodetic& origin, const Vector3& lever_imu_to_base_b,
              double gyro_noise_density);

  Output make(const Estimate& estimate, const ErrorCovariance& P) const;

  const LocalFrame& frame() const { return frame_; }

 private:
  Planet planet_;
  LocalFrame frame_;
  Vector3 lever_b_;
  double gyro_noise_density_;
};

/// Axes forward-right-down to forward-left-up and back.
inline Vector3 swapFrdFlu(const Vector3& v) { return {v.x(), -v.y(), -v.z()}; }

}  // namespace slipnav
