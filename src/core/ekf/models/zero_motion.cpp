#include "slipnav/core/ekf/models/zero_motion.h"

#include <algorithm>

#include "core/base/square.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
void ZeroMotionParams::visit(ParameterVisitor& v) {
  v.number("velocity_std_mps", velocity_std_mps, {1e-7, 1.0},
           "1σ of the velocity at standstill before anything is learned [m/s]");
  v.number("min_velocity_std_mps", min_velocity_std_mps, {1e-7, 1.0}, "smallest 1σ that can be learned [m/s]");
  v.number("max_velocity_std_mps", max_velocity_std_mps, {1e-7, 1.0}, "largest 1σ that can be learned [m/s]");
  v.number("adaptation_samples", adaptation_samples, {1.0, 1e6}, "memory of the learning, in updates");
  v.number("rate_std_deg_per_h", rate_std_deg_per_h, {0.0, 1e6},
           "1σ of the rate at standstill in addition to the gyro noise [°/h]");
}

StandstillNoise::StandstillNoise(const ZeroMotionParams& params)
    : least_variance_(square(params.min_velocity_std_mps)),
      largest_variance_(square(params.max_velocity_std_mps)),
      gain_(1.0 / params.adaptation_samples),
      variance_(square(params.velocity_std_mps)) {}

void StandstillNoise::retune(const ZeroMotionParams& params) {
  least_variance_ = square(params.min_velocity_std_mps);
  largest_variance_ = square(params.max_velocity_std_mps);
  gain_ = 1.0 / params.adaptation_samples;
  variance_ = std::clamp(variance_, least_variance_, largest_variance_);
}

void StandstillNoise::learn(const Vector3& velocity_n, double predicted_variance) {
  const double innovation2 = std::min(velocity_n.squaredNorm() / 3.0, largest_variance_);
  const double share = variance_ / (variance_ + predicted_variance);
  variance_ += gain_ * share * share * (innovation2 - predicted_variance - variance_);
  variance_ = std::clamp(variance_, least_variance_, largest_variance_);
}

Measurement zeroVelocityMeasurement(double variance, const NavigationState& state) {
  Measurement m(3);
  m.residual = -(state.q_b_to_n.conjugate() * state.v_eb_n);
  m.H = bodyVelocityJacobian(state, Vector3::Zero());
  m.variance.setConstant(variance);
  return m;
}

Measurement zeroAngularRateMeasurement(const ZeroMotionParams& params, double gyro_noise_density,
                                       const BodyMotion& motion, const NavigationState& state,
                                       const Vector3& omega_ie_n) {
  const Matrix3 C_n_to_b = state.q_b_to_n.conjugate().toRotationMatrix();
  Measurement m(3);
  m.residual = C_n_to_b * omega_ie_n - motion.omega_ib_b;
  m.H.block<3, 3>(0, kAttitude) = -C_n_to_b * skew(omega_ie_n);
  m.H.block<3, 3>(0, kGyroBias) = -Matrix3::Identity();
  m.variance.setConstant(gyro_noise_density / motion.duration_s + square(degToRad(params.rate_std_deg_per_h) / 3600.0));
  return m;
}

}  // namespace slipnav
