#include "slipnav/core/ekf/error_state.h"

#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav {

void subtractError(const Planet& planet, const ErrorVector& error, NavigationState& state) {
  const double latitude_rad = state.position.latitude_rad;
  const double north_m = planet.meridianRadius(latitude_rad) + state.position.height_m;
  const double east_m = (planet.transverseRadius(latitude_rad) + state.position.height_m) * std::cos(latitude_rad);
  const Vector3 attitude = error.segment<3>(kAttitude);
  state.q_b_to_n = (quaternionFromRotationVector(-attitude) * state.q_b_to_n).normalized();
  state.v_eb_n -= error.segment<3>(kVelocity);
  state.position.latitude_rad -= error(kPosition) / north_m;
  state.position.longitude_rad = wrapToPi(state.position.longitude_rad - error(kPosition + 1) / east_m);
  state.position.height_m += error(kPosition + 2);
  state.accel_bias_b -= error.segment<3>(kAccelBias);
  state.gyro_bias_b -= error.segment<3>(kGyroBias);
  state.imu_offset_b.head<2>() -= error.segment<2>(kImuOffset);
}

void subtractError(const ErrorVector& error, VehicleState& state) {
  state.wheel_scale -= error(kWheelScale);
  state.slow_slip -= error(kSlowSlip);
  state.fast_slip -= error(kFastSlip);
  state.side_slip -= error(kSideSlip);
  state.mount_pitch_rad -= error(kMountPitch);
  state.mount_yaw_rad -= error(kMountYaw);
}

ErrorReset correct(const Planet& planet, const ErrorVector& error, NavigationState& state) {
  const NavigationState before = state;
  subtractError(planet, error, state);
  const Vector3 attitude = error.segment<3>(kAttitude);
  const Matrix3 turn = quaternionFromRotationVector(-attitude).toRotationMatrix();
  const Vector3 xi = error.segment<3>(kVelocity) - attitude.cross(before.v_eb_n);
  state.v_eb_n = turn * (before.v_eb_n - xi);
  ErrorReset reset;
  reset.nav.block<3, 3>(kVelocity, kAttitude) = turn * skew(before.v_eb_n) - skew(state.v_eb_n);
  reset.nav.block<3, 3>(kVelocity, kVelocity) = turn;
  reset.nav.block<3, 3>(kPosition, kAttitude) = -skew(positionDifference(planet, state.position, before.position));
  const Vector3 up_b = state.q_b_to_n.conjugate() * -Vector3::UnitZ();
  const Vector3 across = up_b.cross(error.segment<3>(kAccelBias)) / planet.gravity_n(state.position).z();
  reset.accel_bias = quaternionFromRotationVector(across).toRotationMatrix();
  return reset;
}

void applyReset(const ErrorReset& reset, ErrorCovariance& P) {
  const Eigen::Matrix<double, 3, kErrorStates> accel_bias = reset.accel_bias * P.middleRows<3>(kAccelBias);
  const Matrix3 own = accel_bias.middleCols<3>(kAccelBias) * reset.accel_bias.transpose();
  P.middleRows<3>(kAccelBias) = accel_bias;
  P.middleCols<3>(kAccelBias) = accel_bias.transpose();
  P.block<3, 3>(kAccelBias, kAccelBias) = 0.5 * (own + own.transpose());

  const Eigen::Matrix<double, 9, kErrorStates> top = reset.nav * P.topRows<9>();
  const Eigen::Matrix<double, 9, 9> nav = top.leftCols<9>() * reset.nav.transpose();
  P.topLeftCorner<9, 9>() = 0.5 * (nav + nav.transpose());
  P.topRightCorner<9, kErrorStates - 9>() = top.rightCols<kErrorStates - 9>();
  P.bottomLeftCorner<kErrorStates - 9, 9>() = P.topRightCorner<9, kErrorStates - 9>().transpose();
}

void forgetError(int index, double variance, ErrorCovariance& P) {
  P.row(index).setZero();
  P.col(index).setZero();
  P(index, index) = variance;
}

Vector3 positionDifference(const Planet& planet, const Geodetic& estimate, const Geodetic& truth) {
  const double latitude_rad = truth.latitude_rad;
  const double north_m = planet.meridianRadius(latitude_rad) + truth.height_m;
  const double east_m = (planet.transverseRadius(latitude_rad) + truth.height_m) * std::cos(latitude_rad);
  return {(estimate.latitude_rad - truth.latitude_rad) * north_m,
          wrapToPi(estimate.longitude_rad - truth.longitude_rad) * east_m, truth.height_m - estimate.height_m};
}

ErrorVector errorBetween(const Planet& planet, const NavigationState& estimate, const NavigationState& truth) {
  ErrorVector error = ErrorVector::Zero();
  error.segment<3>(kAttitude) = rotationVectorFromQuaternion(estimate.q_b_to_n * truth.q_b_to_n.conjugate());
  error.segment<3>(kVelocity) = estimate.v_eb_n - truth.v_eb_n;
  error.segment<3>(kPosition) = positionDifference(planet, estimate.position, truth.position);
  error.segment<3>(kAccelBias) = estimate.accel_bias_b - truth.accel_bias_b;
  error.segment<3>(kGyroBias) = estimate.gyro_bias_b - truth.gyro_bias_b;
  error.segment<2>(kImuOffset) = (estimate.imu_offset_b - truth.imu_offset_b).head<2>();
  return error;
}

}  // namespace slipnav
