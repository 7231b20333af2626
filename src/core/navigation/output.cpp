#include "slipnav/core/navigation/output.h"

#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/models/body_motion.h"

namespace slipnav {
namespace {

/// Bandwidth at which the angular rate is published, for its noise variance.
constexpr double kRateBandwidth_hz = 50.0;

/// Diagonal matrix between forward-right-down and forward-left-up.
Matrix3 frdToFlu() { return Vector3(1.0, -1.0, -1.0).asDiagonal(); }

}  // namespace

OutputMaker::OutputMaker(const Planet& planet, const Geodetic& origin, const Vector3& lever_imu_to_base_b,
                         double gyro_noise_density)
    : planet_(planet), frame_(planet, origin), lever_b_(lever_imu_to_base_b), gyro_noise_density_(gyro_noise_density) {}

Output OutputMaker::make(const Estimate& estimate, const ErrorCovariance& P) const {
  const NavigationState& nav = estimate.nav;
  const Matrix3 C_b_to_n = nav.q_b_to_n.toRotationMatrix();
  const Matrix3 C_n_to_enu = frame_.C_n_to_enu(nav.position);
  const Vector3 lever_n = C_b_to_n * lever_b_;
  const Vector3 omega_eb_b = estimate.omega_ib_b - C_b_to_n.transpose() * planet_.omega_ie_n(nav.position.latitude_rad);

  Output out;
  out.stamp = nav.stamp;
  out.position_enu_m = frame_.toEnu(nav.position) + C_n_to_enu * lever_n;
  out.q_flu_to_enu = Quaternion(C_n_to_enu * C_b_to_n * frdToFlu());
  out.velocity_flu_mps = swapFrdFlu(bodyVelocity(nav, omega_eb_b, lever_b_));
  out.angular_rate_flu_radps = swapFrdFlu(omega_eb_b);

  Eigen::Matrix<double, 6, kErrorStates> pose = Eigen::Matrix<double, 6, kErrorStates>::Zero();
  pose.block<3, 3>(0, kPosition) = C_n_to_enu;
  pose.block<3, 3>(0, kAttitude) = -C_n_to_enu * skew(lever_n);
  pose.block<3, 3>(3, kAttitude) = C_n_to_enu;
  out.pose_covariance = pose * P * pose.transpose();

  Eigen::Matrix<double, 6, kErrorStates> twist = Eigen::Matrix<double, 6, kErrorStates>::Zero();
  twist.topRows<3>() = frdToFlu() * bodyVelocityJacobian(nav, lever_b_);
  twist.block<3, 3>(3, kGyroBias) = frdToFlu();
  out.twist_covariance = twist * P * twist.transpose();
  out.twist_covariance.diagonal().tail<3>().array() += gyro_noise_density_ * kRateBandwidth_hz;
  return out;
}

}  // namespace slipnav
