#pragma once
/// Non-holonomic constraints: a wheeled vehicle moves neither sideways nor off the ground (Groves 15.4.1; the paper's
/// equations for z_RC), with side slip and the mounting error of the IMU as states.

#include "slipnav/config/parameter_visitor.h"
#include "slipnav/filter/kalman_update.h"
#include "slipnav/measurement/body_motion.h"

namespace slipnav {

/// Block `nonholonomic`.
struct NonholonomicParams {
  double lateral_std_mps = 0.0012;
  double lateral_slope_std = 0.0075;
  double lateral_turn_std_m = 0.03;
  double vertical_std_mps = 0.001;
  double vertical_slope_std = 0.0033;
  double vertical_turn_std_m = 0.0075;
  double vertical_interval_s = 1.0;
  double max_side_slip_deg = 15.0;
  void visit(ParameterVisitor& v);
};

/// Lateral speed of the reference point: v_y + ψ_m v_x − tan β v_x = 0.
/// @param H_v of motion.v_eb_b; @param ground on the variance of the sway, see GroundFactor
Measurement lateralMeasurement(const NonholonomicParams& params, const BodyMotion& motion, const VelocityJacobian& H_v,
                               const VehicleState& vehicle, double ground);

/// Whether the rover slides sideways so much that the lateral constraint says nothing: the slip angle is beyond its
/// limit and the lateral speed is more than the constraint's own noise can explain.
bool isExcessiveSideSlip(const NonholonomicParams& params, const BodyMotion& motion, const VehicleState& vehicle,
                         double lateral_variance);

/// Vertical speed of the reference point: v_z − θ_m v_x = 0. What the body rises over a stone it comes down again: the
/// noise is that of a difference of heights. Means over `vertical_interval_s` are taken, long enough for it to pass for
/// white.
Measurement verticalMeasurement(const NonholonomicParams& params, const BodyMotion& motion, const VelocityJacobian& H_v,
                                const VehicleState& vehicle);

/// Slip angle β = atan2(v_y, v_x) of the reference point in vehicle axes, forward-right-down [rad]. In reverse it is
/// counted from the backward axis, so that straight driving is zero either way.
double slipAngle(const Vector3& v_eb_b, const VehicleState& vehicle);

}  // namespace slipnav
