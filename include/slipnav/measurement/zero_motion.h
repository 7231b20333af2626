#pragma once
/// What standing still tells: zero velocity, and an angular rate that is the planet's own (Groves 15.3).

#include "slipnav/config/parameter_visitor.h"
#include "slipnav/filter/kalman_update.h"
#include "slipnav/measurement/body_motion.h"

namespace slipnav {

struct ZeroMotionParams {
  double velocity_std_mps = 0.001;
  double rate_std_deg_per_h = 0.0;
  void visit(ParameterVisitor& v);
};

/// v_eb^n = 0, three rows.
Measurement zeroVelocityMeasurement(const ZeroMotionParams& params, const NavigationState& state);

/// ω_ib^b = C_n_to_b ω_ie^n, three rows. The noise is that of the gyros averaged over the interval, with
/// `gyro_noise_density` in rad²/s (angle random walk squared), and what the vehicle's own tremor adds.
Measurement zeroAngularRateMeasurement(const ZeroMotionParams& params, double gyro_noise_density,
                                       const BodyMotion& motion, const NavigationState& state,
                                       const Vector3& omega_ie_n);

}  // namespace slipnav
