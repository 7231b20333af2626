#pragma once
/// Velocity and rate of the vehicle over a measurement interval, as the navigation state predicts them.

#include "slipnav/core/base/types.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav {

/// Means over an interval, at the vehicle's reference point, and the linearization point at its end.
struct BodyMotion {
  double duration_s = 0.0;
  Vector3 v_eb_b = Vector3::Zero();      ///< of the reference point, IMU axes [m/s]
  Vector3 omega_ib_b = Vector3::Zero();  ///< bias-free [rad/s]
};

/// ∂(velocity of the reference point, IMU axes)/∂(error state).
using VelocityJacobian = Eigen::Matrix<double, 3, kErrorStates>;

/// ∂(v_eb_b at the reference point)/∂(error state): Cᵀδv + Cᵀ[v×]δψ + [l×]δb_g (Groves 16.58 and following).
/// @param lever_b from the IMU to the reference point, body axes [m]
VelocityJacobian bodyVelocityJacobian(const NavigationState& state, const Vector3& lever_b);

/// Velocity of the point at `lever_b` from the IMU, body axes [m/s].
Vector3 bodyVelocity(const NavigationState& state, const Vector3& omega_eb_b, const Vector3& lever_b);

}  // namespace slipnav
