#include "slipnav/core/ekf/engine/mean_motion.h"

#include <Eigen/LU>

namespace slipnav {

void MeanMotion::restart(Nanoseconds start) {
  average_.restart(start);
  integral_.setZero();
}

void MeanMotion::propagate(const ErrorTransition& transition) {
  // δx before the step = Φ⁻¹ δx after it, and Φ⁻¹ = 2I − Φ to first order
  const Eigen::Matrix<double, 3, 9> before = integral_.leftCols<9>();
  integral_.leftCols<9>() += before;
  integral_.leftCols<kNavStates>().noalias() -= before * transition.nav;
  integral_.middleCols<2>(kImuOffset).noalias() -= before.middleCols<6>(kVelocity) * transition.motion_from_offset;
}

void MeanMotion::add(const InsStep& step, const Vector3& v_eb_b, const VelocityJacobian& H_v, Nanoseconds from,
                     Nanoseconds to) {
  integral_ += average_.add(step, v_eb_b, from, to) * H_v;
}

void MeanMotion::correct(const ErrorVector& error, const ErrorReset& reset) {
  average_.addTravel(-integral_ * error);
  integral_.leftCols<9>() = (integral_.leftCols<9>() * reset.nav.inverse()).eval();
  integral_.middleCols<3>(kAccelBias) = (integral_.middleCols<3>(kAccelBias) * reset.accel_bias.transpose()).eval();
}

}  // namespace slipnav
