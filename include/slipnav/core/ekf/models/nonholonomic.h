#pragma once
/// Non-holonomic constraints: a wheeled vehicle moves neither sideways nor off the ground (Groves 15.4.1; the paper's
/// equations for z_RC), with side slip and the mounting error of the IMU as states.

#include "slipnav/core/ekf/kalman_update.h"
#include "slipnav/core/ekf/models/body_motion.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `nonholonomic`.
struct NonholonomicParams {
  double lateral_std_mps = 0.003;
  double lateral_slope_std = 0.015;
  double lateral_turn_std_m = 0.0;  ///< a constant turning point is a state; its wander counts as sway
  double vertical_std_mps = 0.003;
  double vertical_slope_std = 0.015;
  double vertical_turn_std_m = 0.03;
  double length_m = 1.0;
  double max_interval_s = 2.0;
  bool see_attitude = true;
  void visit(ParameterVisitor& v);
};

/// Both constraints are measured as means over a distance long enough for the body to sway, pitch and heave about
/// its path, so that errors of successive means are nearly independent. Over a shorter distance the variance is larger
/// in inverse proportion.
/// @param way_m driven in the interval, at least 0
double constraintInformation(const NonholonomicParams& params, double way_m);

/// @param H_v of the mean velocity over the interval. Without `see_attitude` its attitude columns are zero, as in the
/// paper's H_RC: next to wheel speeds that do depend on the attitude, the heading then seems to be observed.
VelocityJacobian constraintJacobian(const NonholonomicParams& params, const VelocityJacobian& H_v);

/// Lateral speed of the reference point: v_y + ψ_m v_x − tan β v_x = 0.
/// @param H_v of motion.v_eb_b; @param factor learned factor on the variance
Measurement lateralMeasurement(const NonholonomicParams& params, const BodyMotion& motion, const VelocityJacobian& H_v,
                               const VehicleState& vehicle, double factor);

/// Vertical speed of the reference point: v_z − θ_m v_x = 0.
Measurement verticalMeasurement(const NonholonomicParams& params, const BodyMotion& motion, const VelocityJacobian& H_v,
                                const VehicleState& vehicle, double factor);

/// Slip angle β = atan2(v_y, v_x) of the reference point in vehicle axes, forward-right-down [rad]. In reverse it is
/// measured from the backward axis, so that straight driving is zero either way.
double slipAngle(const Vector3& v_eb_b, const VehicleState& vehicle);

}  // namespace slipnav
