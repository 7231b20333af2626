#pragma once
/// Wheel speed and wheel heading rate as measurements of the error state (Groves 16.3), with slip as states.

#include <string>

#include "slipnav/core/ekf/kalman_update.h"
#include "slipnav/core/ekf/models/body_motion.h"
#include "slipnav/core/ekf/models/noise_factors.h"
#include "slipnav/core/parameters/parameter_visitor.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// Block `wheel`.
struct WheelOdometryParams {
  std::string source = "auto";
  double odometry_scale = 1.0;
  double stamp_delay_s = 0.0;
  double speed_std_mps = 0.01;
  double slip_noise_std = 0.006;
  double stamp_std_s = 0.03;
  double yaw_rate_std_deg_per_s = 3.3;
  double yaw_rate_scale_std = 0.3;
  double yaw_rate_length_m = 5.0;
  double scrub_factor = 1.0;
  void visit(ParameterVisitor& v);
};

/// Wheel motion over one interval.
struct WheelInterval {
  double speed_mps = 0.0;           ///< u: mean circumferential speed
  double slipping_speed_mps = 0.0;  ///< ū: the speed that slip is a ratio of, see SlippingSpeed
  double duration_s = 0.0;
  double acceleration_mps2 = 0.0;  ///< of the vehicle, predicted
};

/// Forward speed: u = v_x + ū (κ + s_slow + s_fast). The slip ratio is defined relative to u itself, so ū ≈ u; but with
/// u, noise of u would look like slip (errors in variables), and with a product of estimated states, the direction in
/// which speed and slip cannot be separated would rotate with every update and the filter would believe it knows
/// both. While the rover accelerates ū lags behind, and stamp errors show: both count as noise.
/// The variance combines a density in time for the encoders and one in distance for the slip, so that encoders of any
/// rate give the same information.
/// @param motion means over the interval; @param H_v of motion.v_eb_b
/// @param slip_variance of the estimated κ + s_slow + s_fast
Measurement forwardSpeedMeasurement(const WheelOdometryParams& params, const WheelInterval& wheels,
                                    const BodyMotion& motion, const VelocityJacobian& H_v, const VehicleState& vehicle,
                                    double slip_variance, const NoiseFactors& factors);

/// The part of that variance that is white wheel-speed noise, and slip that is new in every interval.
double wheelNoiseVariance(const WheelOdometryParams& params, double duration_s, const NoiseFactors& factors);
double newSlipVariance(const WheelOdometryParams& params, const WheelInterval& wheels, const NoiseFactors& factors);

/// Heading rate: (v_left − v_right) / (track · scrub) against the gyros' rate about body z. Scrub and the slip of one
/// side last for `yaw_rate_length_m`: over a shorter distance the variance is larger in inverse proportion.
/// @param way_m of the wheels' surface in the interval
Measurement yawRateMeasurement(const WheelOdometryParams& params, double wheel_yaw_rate_radps, double way_m,
                               const BodyMotion& motion);

}  // namespace slipnav
