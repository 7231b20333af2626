#include "slipnav/measurement/zero_motion.h"

#include "slipnav/math/rotation.h"

namespace slipnav {

void ZeroMotionParams::visit(ParameterVisitor& v) {
  v.number("velocity_std_mps", velocity_std_mps, {1e-7, 1.0}, "1σ of the velocity at standstill [m/s]");
  v.number("rate_std_deg_per_h", rate_std_deg_per_h, {0.0, 1e6},
           "1σ of the rate at standstill beside the gyro's own noise [°/h]");
}

Measurement zeroVelocityMeasurement(const ZeroMotionParams& params, const NavigationState& state) {
  Measurement m(3);
  m.residual = -state.v_eb_n;
  m.H.block<3, 3>(0, kVelocity).setIdentity();
  m.variance.setConstant(params.velocity_std_mps * params.velocity_std_mps);
  return m;
}

Measurement zeroAngularRateMeasurement(const ZeroMotionParams& params, double gyro_noise_density,
                                       const BodyMotion& motion, const NavigationState& state,
                                       const Vector3& omega_ie_n) {
  const Matrix3 C_n_to_b = state.q_b_to_n.conjugate().toRotationMatrix();
  const double tremor_radps = degToRad(params.rate_std_deg_per_h) / 3600.0;
  Measurement m(3);
  m.residual = C_n_to_b * omega_ie_n - motion.omega_ib_b;
  m.H.block<3, 3>(0, kAttitude) = -C_n_to_b * skew(omega_ie_n);
  m.H.block<3, 3>(0, kGyroBias) = -Matrix3::Identity();
  m.variance.setConstant(gyro_noise_density / motion.duration_s + tremor_radps * tremor_radps);
  return m;
}

}  // namespace slipnav
