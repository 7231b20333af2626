#pragma once
/// Layout of the error state and how an estimated error is removed from the total state.
///
/// One sign convention everywhere: error = estimate − truth. The attitude error δψ is the small rotation, resolved in
/// north-east-down, with C_b_to_n(estimate) = (I + [δψ×]) C_b_to_n(truth); position error is in meters.

#include "slipnav/core/base/types.h"
#include "slipnav/core/earth/planet.h"
#include "slipnav/core/ins/nav_state.h"

namespace slipnav {

/// First index of each block of the error state.
enum ErrorIndex : int {
  kAttitude = 0,   ///< δψ_nb^n [rad]
  kVelocity = 3,   ///< δv_eb^n [m/s]
  kPosition = 6,   ///< δp, north-east-down [m]
  kAccelBias = 9,  ///< [m/s²]
  kGyroBias = 12,  ///< [rad/s]
  kNavStates = 15,
  kWheelScale = 15,  ///< relative error of the wheel radii; constant
  kSlowSlip = 16,    ///< slip ratio that persists over tens of seconds; Gauss–Markov
  kFastSlip = 17,    ///< slip ratio that changes within seconds; Gauss–Markov
  kSideSlip = 18,    ///< tangent of the angle from the body's x axis to its course over ground; Gauss–Markov
  kMountPitch = 19,  ///< pitch of the IMU's axes against the vehicle's [rad]; constant
  kMountYaw = 20,    ///< yaw of the IMU's axes against the vehicle's [rad]; constant
  kImuOffset = 21,   ///< where the IMU is, forward and right of its configured place [m]; constant
  kYawScale = 23,    ///< scale factor error of the gyro about body z; considered, never estimated
  kErrorStates = 24
};

using ErrorVector = Eigen::Matrix<double, kErrorStates, 1>;
using ErrorCovariance = Eigen::Matrix<double, kErrorStates, kErrorStates>;
using NavCovariance = Eigen::Matrix<double, kNavStates, kNavStates>;

/// Estimates beyond the fifteen navigation states: the vehicle and its ground.
struct VehicleState {
  double wheel_scale = 0.0;
  double slow_slip = 0.0;
  double fast_slip = 0.0;
  double side_slip = 0.0;
  double mount_pitch_rad = 0.0;
  double mount_yaw_rad = 0.0;
};

/// Removes an estimated error from the navigation state: truth = estimate − error.
void subtractError(const Planet& planet, const ErrorVector& error, NavigationState& state);
void subtractError(const ErrorVector& error, VehicleState& state);

/// ∂(error about the corrected state)/∂(remaining error about the previous one). Other errors are unaffected.
struct ErrorReset {
  Eigen::Matrix<double, 9, 9> nav = Eigen::Matrix<double, 9, 9>::Identity();  ///< attitude, velocity, position
  Matrix3 accel_bias = Matrix3::Identity();                                   ///< a rotation
};

/// Removes an error that may be large, as after an IMU gap: the linear quantity is not δv but the velocity error
/// after the attitude error has been removed, ξ = v̂ − R v with R = exp[δψ×], of which the body-frame velocity
/// is an exactly linear function (the right-invariant error: A. Barrau, S. Bonnabel, The invariant extended Kalman
/// filter as a stable observer, IEEE TAC 62(4), 2017). The reset keeps the information in those terms while the point
/// of linearization moves; without it the filter would believe it learns its heading, which nothing observes. It omits
/// the rotation of δψ by half the correction: an unknown heading does not change what is known of the tilt.
///
/// An accelerometer at rest observes the magnitude of gravity, not its direction: of the bias it sees the component
/// along the specific force, and the rest cannot be separated from the tilt. When the bias is corrected across that
/// direction, the direction rotates along the sphere |f̃ − b| = g, and the information must rotate too (the bias error
/// in the frame that the group acts in: A. Barrau, S. Bonnabel, The geometry of navigation problems, IEEE TAC 68(2),
/// 2023). Otherwise the filter would see the bias from a second direction and believe it knows all of it.
ErrorReset correct(const Planet& planet, const ErrorVector& error, NavigationState& state);

/// Carries P over to the corrected state.
void applyReset(const ErrorReset& reset, ErrorCovariance& P);

/// Resets one error to `variance`, independent of all others.
void forgetError(int index, double variance, ErrorCovariance& P);

/// Position error [m], north-east-down, of `estimate` against `truth` (small differences).
Vector3 positionDifference(const Planet& planet, const Geodetic& estimate, const Geodetic& truth);

/// Error of `estimate` against `truth` in the layout above; vehicle states are zero.
ErrorVector errorBetween(const Planet& planet, const NavigationState& estimate, const NavigationState& truth);

}  // namespace slipnav
