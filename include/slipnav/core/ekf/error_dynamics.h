#pragma once
/// Linearized propagation of the error state through one strapdown step (Groves 14.2.4, position in meters).

#include "slipnav/core/ekf/error_state.h"
#include "slipnav/core/ekf/stationary_detector.h"
#include "slipnav/core/ins/strapdown.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Noise of the IMU in the units of its data sheet. Defaults: Analog Devices ADIS16495.
struct ImuNoiseParams {
  double accel_noise_mps_per_sqrt_h = 0.008;
  double gyro_noise_deg_per_sqrt_h = 0.1;
  double accel_bias_std_ug = 1500.0;
  double gyro_bias_std_deg_per_h = 250.0;
  double accel_bias_walk_ug_per_sqrt_h = 100.0;
  double gyro_bias_walk_deg_per_h_per_sqrt_h = 3.5;
  double gyro_scale_std_ppm = 200.0;
  void visit(ParameterVisitor& v);
};

/// The data sheet in SI units.
ImuFloor imuFloor(const ImuNoiseParams& params);

/// How vehicle and ground behave between measurements.
struct VehicleModelParams {
  double wheel_scale_std = 0.01;
  double slow_slip_std = 0.04;
  double slow_slip_length_m = 60.0;
  double slope_slip = 0.2;
  double fast_slip_std = 0.07;
  double fast_slip_length_m = 0.5;
  double side_slip_std_deg = 0.4;
  double side_slip_length_m = 8.0;
  double mount_pitch_std_deg = 0.3;
  double mount_yaw_std_deg = 0.5;
  double mount_position_std_m = 0.2;
  void visit(ParameterVisitor& v);
};

/// Discrete transition of one step. Only the navigation rows are dense: biases and vehicle states decay independently.
struct ErrorTransition {
  Eigen::Matrix<double, 9, kNavStates> nav;        ///< attitude, velocity, position rows against all navigation states
  Vector3 attitude_from_yaw_scale;                 ///< column of kYawScale in the attitude rows
  Vector3 velocity_from_yaw_scale;                 ///< column of kYawScale in the velocity rows
  Eigen::Matrix<double, 6, 2> motion_from_offset;  ///< columns of kImuOffset in the velocity and position rows
  Eigen::Matrix<double, kErrorStates - 9, 1> decay;  ///< diagonal of the remaining rows
  ErrorVector noise;  ///< diagonal of the continuous noise integrated over the step, Q_c Δt

  /// The whole 24×24 matrix Φ.
  ErrorCovariance matrix() const;

  /// Φ X of as many error vectors as X has columns.
  template <typename Errors>
  Errors times(const Errors& X) const {
    Errors product = Errors::Zero(X.rows(), X.cols());
    product.template topRows<9>() = nav.lazyProduct(X.template topRows<kNavStates>());
    product.template middleRows<3>(kAttitude) += attitude_from_yaw_scale.lazyProduct(X.row(kYawScale));
    product.template middleRows<3>(kVelocity) += velocity_from_yaw_scale.lazyProduct(X.row(kYawScale));
    product.template middleRows<6>(kVelocity) += motion_from_offset.lazyProduct(X.template middleRows<2>(kImuOffset));
    product.template bottomRows<kErrorStates - 9>() = decay.asDiagonal() * X.template bottomRows<kErrorStates - 9>();
    return product;
  }
};

/// The ground covered in a step, as steady-state variances of the slip states.
struct GroundStep {
  double way_m = 0.0;  ///< of the wheels' surface
  double slow_slip_variance = 0.0;
  double fast_slip_variance = 0.0;
  double side_slip_variance = 0.0;
};

/// F, Φ and Q of the 24 error states for one planet, IMU and vehicle. Immutable.
class ErrorDynamics {
 public:
  ErrorDynamics(const Planet& planet, const ImuNoiseParams& imu, const VehicleModelParams& vehicle);

  /// F of the navigation rows, continuous time: d/dt δx = F δx (Groves 14.63 with bias errors defined as
  /// estimate − truth, hence −C in the bias columns).
  /// @param middle state at mid-step
  /// @param f_ib_b bias-corrected mean specific force of the step [m/s²]
  Eigen::Matrix<double, 9, kNavStates> systemMatrix(const NavigationState& middle, const Vector3& f_ib_b) const;

  /// Φ to second order and the noise of a step of `duration_s`, linearized at its middle.
  /// @param rate_change_b by how much the mean rate differs from that of the step before [rad/s]
  ErrorTransition transition(const NavigationState& start, const NavigationState& end, const Vector3& f_ib_b,
                             const Vector3& omega_ib_b, const Vector3& rate_change_b, double duration_s) const;

  /// Propagates the slip states over the distance of a step: a Gauss–Markov process of variance σ² and length L
  /// decays by exp(−w/L) over a distance w and keeps σ². Slip belongs to the ground: a rover at rest keeps it.
  void rollOver(const GroundStep& ground, ErrorTransition& transition) const;

  /// Configured steady-state variances of slow, fast and side slip.
  GroundStep ground() const;

  /// P ← Φ (P + ½Q_cΔt) Φᵀ + ½Q_cΔt, second order in the step (Groves 14.80).
  static void propagate(const ErrorTransition& transition, ErrorCovariance& P);

  /// Applies the decay of the transition to the estimates of Gauss–Markov states.
  static void decay(const ErrorTransition& transition, VehicleState& vehicle);

  /// Density of the gyros' white noise [rad²/s].
  double gyroNoiseDensity() const { return spectral_density_(kAttitude); }

  /// Prior variances of everything beyond attitude, velocity and position.
  ErrorVector priorVariance() const { return prior_variance_; }

 private:
  Planet planet_;
  ErrorVector prior_variance_;
  ErrorVector spectral_density_;  ///< continuous, one-sided in time: variance per second
  VehicleModelParams vehicle_;
};

}  // namespace slipnav
