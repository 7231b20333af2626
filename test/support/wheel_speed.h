#pragma once
/// The wheel speed measurement with everything that does not matter for a test left at its default.

#include "slipnav/core/ekf/models/wheel_odometry.h"

namespace slipnav::test {

/// A wheel speed that has been the same for a while.
inline Measurement steadyWheelSpeed(const WheelOdometryParams& params, double wheel_speed_mps, const BodyMotion& motion,
                                    const NavigationState& state, const VehicleState& vehicle, const Vector3& lever_b) {
  return forwardSpeedMeasurement(params, {wheel_speed_mps, wheel_speed_mps, motion.duration_s, 0.0}, motion,
                                 bodyVelocityJacobian(state, lever_b), vehicle, 0.0, {});
}

}  // namespace slipnav::test
