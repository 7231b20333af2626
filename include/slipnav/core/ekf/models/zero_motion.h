#pragma once
/// What standing still reveals: zero velocity, and an angular rate equal to the planet's (Groves 15.3).

#include "slipnav/core/ekf/kalman_update.h"
#include "slipnav/core/ekf/models/body_motion.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `zero_motion`.
struct ZeroMotionParams {
  double velocity_std_mps = 0.002;
  double min_velocity_std_mps = 0.00002;
  double max_velocity_std_mps = 0.02;
  double adaptation_samples = 20.0;
  double rate_std_deg_per_h = 0.0;
  void visit(ParameterVisitor& v);
};

/// Variance of the rover's velocity at standstill, learned from the innovations of zero-velocity
/// updates. E[r²] = H P Hᵀ + R, so R follows r² − H P Hᵀ, weighted by how much of the innovation R explains.
class StandstillNoise {
 public:
  explicit StandstillNoise(const ZeroMotionParams& params);

  /// Other limits and memory from now on; what was learned stays, within the limits.
  void retune(const ZeroMotionParams& params);

  /// Of the velocity on each axis [m²/s²].
  double variance() const { return variance_; }
  void setVariance(double variance) { variance_ = variance; }

  /// @param velocity_n estimated velocity at standstill before the update
  /// @param predicted_variance mean over the axes of its variance in P
  void learn(const Vector3& velocity_n, double predicted_variance);

 private:
  double least_variance_;
  double largest_variance_;
  double gain_;
  double variance_;
};

/// v_eb^b = 0, three rows, each with the standstill variance. In body axes: a velocity there says nothing
/// about the heading, whatever the point of linearization.
Measurement zeroVelocityMeasurement(double variance, const NavigationState& state);

/// ω_ib^b = C_n_to_b ω_ie^n, three rows. The noise is that of the gyros averaged over the interval, with
/// `gyro_noise_density` in rad²/s (angle random walk squared), plus the configured rate noise at standstill.
Measurement zeroAngularRateMeasurement(const ZeroMotionParams& params, double gyro_noise_density,
                                       const BodyMotion& motion, const NavigationState& state,
                                       const Vector3& omega_ie_n);

}  // namespace slipnav
