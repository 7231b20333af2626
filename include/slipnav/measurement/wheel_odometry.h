#pragma once
/// Wheel speed and wheel heading rate as measurements of the error state (Groves 16.3), with slip as states.

#include <string>

#include "slipnav/config/parameter_visitor.h"
#include "slipnav/filter/kalman_update.h"
#include "slipnav/measurement/body_motion.h"
#include "slipnav/measurement/wheel_geometry.h"

namespace slipnav {

/// Block `wheel`.
struct WheelOdometryParams {
  std::string source = "auto";
  double stamp_delay_s = 0.0;
  double speed_std_mps = 0.002;
  double slip_noise_std = 0.006;
  double yaw_rate_std_deg_per_s = 3.3;
  double yaw_rate_scale_std = 0.3;
  double scrub_factor = 1.0;
  void visit(ParameterVisitor& v);
};

/// Forward speed: u = v_x + ū (κ + s_slow + s_fast), with u the mean circumferential speed of the wheels and ū what it
/// was just before. The slip ratio is defined by u itself, so ū ≈ u; but were it u, noise of u would look like slip
/// (errors in variables), and were it a product of estimated states, the direction in which speed and slip cannot be
/// told apart would turn with every update and the filter would believe that it knows them.
/// While the rover brakes or accelerates ū is not u; what that does to the product counts as noise.
/// @param wheel_speed_mps u; @param slipping_speed_mps ū; @param motion means over the odometry interval
/// @param H_v of motion.v_eb_b; @param slip_variance of the estimated κ + s_slow + s_fast
/// @param ground on the variance of slip that is new in every sample, see GroundFactor
Measurement forwardSpeedMeasurement(const WheelOdometryParams& params, double wheel_speed_mps,
                                    double slipping_speed_mps, const BodyMotion& motion, const VelocityJacobian& H_v,
                                    const VehicleState& vehicle, double slip_variance, double ground);

/// Heading rate: (v_left − v_right) / (track · scrub) against the gyros' rate about body z.
Measurement yawRateMeasurement(const WheelOdometryParams& params, double wheel_yaw_rate_radps,
                               const BodyMotion& motion);

}  // namespace slipnav
