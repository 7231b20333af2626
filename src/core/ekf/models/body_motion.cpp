#include "slipnav/core/ekf/models/body_motion.h"

#include "slipnav/core/base/rotation.h"

namespace slipnav {

VelocityJacobian bodyVelocityJacobian(const NavigationState& state, const Vector3& lever_b) {
  const Matrix3 C_n_to_b = state.q_b_to_n.conjugate().toRotationMatrix();
  VelocityJacobian H = VelocityJacobian::Zero();
  H.block<3, 3>(0, kAttitude) = C_n_to_b * skew(state.v_eb_n);
  H.block<3, 3>(0, kVelocity) = C_n_to_b;
  H.block<3, 3>(0, kGyroBias) = skew(lever_b);
  return H;
}

Vector3 bodyVelocity(const NavigationState& state, const Vector3& omega_eb_b, const Vector3& lever_b) {
  return state.q_b_to_n.conjugate() * state.v_eb_n + omega_eb_b.cross(lever_b);
}

}  // namespace slipnav
