#include "slipnav/core/ekf/error_dynamics.h"

#include <cmath>

#include "core/base/square.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

constexpr double kSecondsPerHour = 3600.0;

NavigationState midpoint(const NavigationState& start, const NavigationState& end) {
  NavigationState middle = end;
  middle.q_b_to_n = start.q_b_to_n.slerp(0.5, end.q_b_to_n);
  middle.v_eb_n = 0.5 * (start.v_eb_n + end.v_eb_n);
  return middle;
}

/// ∂(ω_en^n)/∂(v_eb^n), Groves (5.44).
Matrix3 transportRateByVelocity(double north_m, double east_m, double latitude_rad) {
  Matrix3 m = Matrix3::Zero();
  m(0, 1) = 1.0 / east_m;
  m(1, 0) = -1.0 / north_m;
  m(2, 1) = -std::tan(latitude_rad) / east_m;
  return m;
}

/// ∂(ω_en^n)/∂(position in meters NED). The curvature's own change with latitude is below 1e-2 of these terms.
Matrix3 transportRateByPosition(double north_m, double east_m, double latitude_rad, const Vector3& v) {
  const double tan_lat = std::tan(latitude_rad);
  Matrix3 m = Matrix3::Zero();
  m(0, 2) = v.y() / square(east_m);
  m(1, 2) = -v.x() / square(north_m);
  m(2, 2) = -v.y() * tan_lat / square(east_m);
  m(2, 0) = -v.y() / (east_m * square(std::cos(latitude_rad)) * north_m);
  return m;
}

}  // namespace

void ImuNoiseParams::visit(ParameterVisitor& v) {
  v.number("accel_noise_mps_per_sqrt_h", accel_noise_mps_per_sqrt_h, {1e-6, 100.0},
           "velocity random walk of each accelerometer [m/s/√h]");
  v.number("gyro_noise_deg_per_sqrt_h", gyro_noise_deg_per_sqrt_h, {1e-6, 1000.0},
           "angle random walk of each gyro [°/√h]");
  v.number("accel_bias_std_ug", accel_bias_std_ug, {0.0, 1e6}, "1σ of the accelerometer bias at switch-on [µg]");
  v.number("gyro_bias_std_deg_per_h", gyro_bias_std_deg_per_h, {0.0, 1e6}, "1σ of the gyro bias at switch-on [°/h]");
  v.number("accel_bias_walk_ug_per_sqrt_h", accel_bias_walk_ug_per_sqrt_h, {0.0, 1e6},
           "random walk of the accelerometer bias [µg/√h]");
  v.number("gyro_bias_walk_deg_per_h_per_sqrt_h", gyro_bias_walk_deg_per_h_per_sqrt_h, {0.0, 1e6},
           "random walk of the gyro bias [°/h/√h]");
  v.number("gyro_scale_std_ppm", gyro_scale_std_ppm, {0.0, 1e5},
           "1σ of the scale factor error of the gyro about the vertical axis [ppm]");
}

ImuFloor imuFloor(const ImuNoiseParams& params) {
  return {square(params.accel_noise_mps_per_sqrt_h) / kSecondsPerHour,
          square(degToRad(params.gyro_noise_deg_per_sqrt_h)) / kSecondsPerHour, params.accel_bias_std_ug * kMicroG,
          degPerHourToRadps(params.gyro_bias_std_deg_per_h)};
}

void VehicleModelParams::visit(ParameterVisitor& v) {
  v.number("wheel_scale_std", wheel_scale_std, {0.0, 1.0}, "1σ of the relative error of the wheel radii");
  v.number("slow_slip_std", slow_slip_std, {0.0, 1.0},
           "1σ of the slip ratio that persists over tens of meters, before anything is learned");
  v.number("slow_slip_length_m", slow_slip_length_m, {1e-2, 1e5}, "correlation length of the persistent slip [m]");
  v.number("slope_slip", slope_slip, {0.0, 1.0},
           "1σ of the persistent slip, and of the tangent of the side slip, per sine of the slope");
  v.number("fast_slip_std", fast_slip_std, {0.0, 1.0},
           "1σ of the slip ratio that changes within a meter; larger values are learned, never smaller ones");
  v.number("fast_slip_length_m", fast_slip_length_m, {1e-2, 1e5}, "correlation length of the fast slip [m]");
  v.number("side_slip_std_deg", side_slip_std_deg, {0.0, 45.0},
           "1σ of the side-slip angle, before anything is learned [°]");
  v.number("side_slip_length_m", side_slip_length_m, {1e-2, 1e5}, "correlation length of the side slip [m]");
  v.number("mount_pitch_std_deg", mount_pitch_std_deg, {0.0, 10.0}, "1σ of the IMU's mounting error in pitch [°]");
  v.number("mount_yaw_std_deg", mount_yaw_std_deg, {0.0, 10.0}, "1σ of the IMU's mounting error in yaw [°]");
  v.number(
      "mount_position_std_m", mount_position_std_m, {0.0, 10.0},
      "1σ of where the IMU is, forward and across, relative to the point that does not slide sideways in a turn [m]");
}

ErrorCovariance ErrorTransition::matrix() const { return times(ErrorCovariance(ErrorCovariance::Identity())); }

ErrorDynamics::ErrorDynamics(const Planet& planet, const ImuNoiseParams& imu, const VehicleModelParams& vehicle)
    : planet_(planet), prior_variance_(ErrorVector::Zero()), spectral_density_(ErrorVector::Zero()), vehicle_(vehicle) {
  prior_variance_.segment<3>(kAccelBias).setConstant(square(imu.accel_bias_std_ug * kMicroG));
  prior_variance_.segment<3>(kGyroBias).setConstant(square(degPerHourToRadps(imu.gyro_bias_std_deg_per_h)));
  prior_variance_(kWheelScale) = square(vehicle.wheel_scale_std);
  prior_variance_(kMountPitch) = square(degToRad(vehicle.mount_pitch_std_deg));
  prior_variance_(kMountYaw) = square(degToRad(vehicle.mount_yaw_std_deg));
  prior_variance_(kYawScale) = square(imu.gyro_scale_std_ppm * 1e-6);
  prior_variance_.segment<2>(kImuOffset).setConstant(square(vehicle.mount_position_std_m));

  spectral_density_.segment<3>(kAttitude).setConstant(square(degToRad(imu.gyro_noise_deg_per_sqrt_h)) /
                                                      kSecondsPerHour);
  spectral_density_.segment<3>(kVelocity).setConstant(square(imu.accel_noise_mps_per_sqrt_h) / kSecondsPerHour);
  spectral_density_.segment<3>(kAccelBias)
      .setConstant(square(imu.accel_bias_walk_ug_per_sqrt_h * kMicroG) / kSecondsPerHour);
  spectral_density_.segment<3>(kGyroBias).setConstant(
      square(degPerHourToRadps(imu.gyro_bias_walk_deg_per_h_per_sqrt_h)) / kSecondsPerHour);

  const GroundStep usual = ground();
  prior_variance_(kSlowSlip) = usual.slow_slip_variance;
  prior_variance_(kFastSlip) = usual.fast_slip_variance;
  prior_variance_(kSideSlip) = usual.side_slip_variance;
}

GroundStep ErrorDynamics::ground() const {
  return {0.0, square(vehicle_.slow_slip_std), square(vehicle_.fast_slip_std),
          square(std::tan(degToRad(vehicle_.side_slip_std_deg)))};
}

void ErrorDynamics::rollOver(const GroundStep& ground, ErrorTransition& transition) const {
  const auto gaussMarkov = [&](int state, double variance, double length_m) {
    const double decay = std::exp(-ground.way_m / length_m);
    transition.decay(state - 9) = decay;
    // half of the noise is added before the decay, see propagate(): this keeps σ² in steady state for any step
    transition.noise(state) = 2.0 * variance * (1.0 - decay * decay) / (1.0 + decay * decay);
  };
  gaussMarkov(kSlowSlip, ground.slow_slip_variance, vehicle_.slow_slip_length_m);
  gaussMarkov(kFastSlip, ground.fast_slip_variance, vehicle_.fast_slip_length_m);
  gaussMarkov(kSideSlip, ground.side_slip_variance, vehicle_.side_slip_length_m);
}

Eigen::Matrix<double, 9, kNavStates> ErrorDynamics::systemMatrix(const NavigationState& middle,
                                                                 const Vector3& f_ib_b) const {
  const double latitude_rad = middle.position.latitude_rad;
  const double north_m = planet_.meridianRadius(latitude_rad) + middle.position.height_m;
  const double east_m = planet_.transverseRadius(latitude_rad) + middle.position.height_m;
  const Vector3& v = middle.v_eb_n;
  const Vector3 omega_ie_n = planet_.omega_ie_n(latitude_rad);
  const Vector3 omega_en_n = planet_.omega_en_n(middle.position, v);
  const Matrix3 C_b_to_n = middle.q_b_to_n.toRotationMatrix();
  const Matrix3 en_by_v = transportRateByVelocity(north_m, east_m, latitude_rad);
  const Matrix3 en_by_p = transportRateByPosition(north_m, east_m, latitude_rad, v);
  Matrix3 ie_by_p = Matrix3::Zero();
  ie_by_p(0, 0) = omega_ie_n.z() / north_m;
  ie_by_p(2, 0) = -omega_ie_n.x() / north_m;

  Eigen::Matrix<double, 9, kNavStates> F = Eigen::Matrix<double, 9, kNavStates>::Zero();
  F.block<3, 3>(kAttitude, kAttitude) = -skew(omega_ie_n + omega_en_n);
  F.block<3, 3>(kAttitude, kVelocity) = -en_by_v;
  F.block<3, 3>(kAttitude, kPosition) = -(ie_by_p + en_by_p);
  F.block<3, 3>(kAttitude, kGyroBias) = -C_b_to_n;

  F.block<3, 3>(kVelocity, kAttitude) = -skew(C_b_to_n * f_ib_b);
  F.block<3, 3>(kVelocity, kVelocity) = -skew(2.0 * omega_ie_n + omega_en_n) + skew(v) * en_by_v;
  F.block<3, 3>(kVelocity, kPosition) = skew(v) * (2.0 * ie_by_p + en_by_p);
  const double g = planet_.gravity_n(middle.position).z();
  F(kVelocity + 2, kPosition + 2) += 2.0 * g / (planet_.equatorialRadius() + middle.position.height_m);
  F.block<3, 3>(kVelocity, kAccelBias) = -C_b_to_n;

  F.block<3, 3>(kPosition, kVelocity).setIdentity();
  F(kPosition, kPosition) = -v.z() / north_m;
  F(kPosition, kPosition + 2) = v.x() / north_m;
  F(kPosition + 1, kPosition) = v.y() * std::tan(latitude_rad) / north_m;
  F(kPosition + 1, kPosition + 1) = -v.z() / east_m - v.x() * std::tan(latitude_rad) / north_m;
  F(kPosition + 1, kPosition + 2) = v.y() / east_m;
  return F;
}

ErrorTransition ErrorDynamics::transition(const NavigationState& start, const NavigationState& end,
                                          const Vector3& f_ib_b, const Vector3& omega_ib_b,
                                          const Vector3& rate_change_b, double duration_s) const {
  const NavigationState middle = midpoint(start, end);
  // with the specific force at the IMU itself, the heading would count as observed
  const Vector3& offset_b = start.imu_offset_b;
  const Vector3 f_b =
      f_ib_b - rate_change_b.cross(offset_b) / duration_s - omega_ib_b.cross(omega_ib_b.cross(offset_b));
  const Eigen::Matrix<double, 9, kNavStates> F_dt = systemMatrix(middle, f_b) * duration_s;
  ErrorTransition t;
  t.nav = F_dt;
  t.nav.noalias() += 0.5 * F_dt.leftCols<9>() * F_dt;
  t.nav.leftCols<9>().diagonal().array() += 1.0;
  t.attitude_from_yaw_scale = -omega_ib_b.z() * duration_s * (middle.q_b_to_n * Vector3::UnitZ());
  t.velocity_from_yaw_scale = 0.5 * F_dt.block<3, 3>(kVelocity, kAttitude) * t.attitude_from_yaw_scale;
  const Matrix3 turn_b = skew(omega_ib_b);
  const Matrix3 by_offset = -middle.q_b_to_n.toRotationMatrix() * (skew(rate_change_b) + turn_b * turn_b * duration_s);
  t.motion_from_offset.topRows<3>() = by_offset.leftCols<2>();
  t.motion_from_offset.bottomRows<3>() = 0.5 * duration_s * by_offset.leftCols<2>();
  t.decay.setOnes();
  t.noise = spectral_density_ * duration_s;
  return t;
}

void ErrorDynamics::propagate(const ErrorTransition& t, ErrorCovariance& P) {
  P.diagonal() += 0.5 * t.noise;
  // (Φ P)ᵀ for the rows of attitude, velocity and position, then their symmetric product. Small products column by
  // column: Eigen's kernel for large ones takes longer.
  Eigen::Matrix<double, kErrorStates, 9> top;
  for (int row = 0; row < 9; ++row) {
    ErrorVector sum = t.nav(row, 0) * P.col(0);
    for (int k = 1; k < kNavStates; ++k) {
      sum += t.nav(row, k) * P.col(k);
    }
    top.col(row) = sum;
  }
  const ErrorVector yaw_scale = P.col(kYawScale);
  top.middleCols<3>(kAttitude) += yaw_scale.lazyProduct(t.attitude_from_yaw_scale.transpose());
  top.middleCols<3>(kVelocity) += yaw_scale.lazyProduct(t.velocity_from_yaw_scale.transpose());
  top.middleCols<6>(kVelocity) += P.middleCols<2>(kImuOffset).lazyProduct(t.motion_from_offset.transpose());

  Eigen::Matrix<double, 9, 9> nav;
  for (int column = 0; column < 9; ++column) {
    Eigen::Matrix<double, 9, 1> sum = t.nav.col(0) * top(0, column);
    for (int k = 1; k < kNavStates; ++k) {
      sum += t.nav.col(k) * top(k, column);
    }
    nav.col(column) = sum;
  }
  nav.middleRows<3>(kAttitude) += t.attitude_from_yaw_scale.lazyProduct(top.row(kYawScale));
  nav.middleRows<3>(kVelocity) += t.velocity_from_yaw_scale.lazyProduct(top.row(kYawScale));
  nav.middleRows<6>(kVelocity) += t.motion_from_offset.lazyProduct(top.middleRows<2>(kImuOffset));

  P.topLeftCorner<9, 9>() = 0.5 * (nav + nav.transpose());
  P.bottomLeftCorner<kErrorStates - 9, 9>() = t.decay.asDiagonal() * top.bottomRows<kErrorStates - 9>();
  P.topRightCorner<9, kErrorStates - 9>() = P.bottomLeftCorner<kErrorStates - 9, 9>().transpose();
  P.bottomRightCorner<kErrorStates - 9, kErrorStates - 9>().array() *= (t.decay * t.decay.transpose()).array();
  P.diagonal() += 0.5 * t.noise;
}

void ErrorDynamics::decay(const ErrorTransition& t, VehicleState& vehicle) {
  vehicle.slow_slip *= t.decay(kSlowSlip - 9);
  vehicle.fast_slip *= t.decay(kFastSlip - 9);
  vehicle.side_slip *= t.decay(kSideSlip - 9);
}

}  // namespace slipnav
