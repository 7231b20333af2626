/// The part of FilterEngine that restarts the estimate when it has run away.

#include "core/base/square.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/engine/filter_engine.h"

namespace slipnav {

/// Position and heading are kept: nothing else knows them. The velocity comes from the wheels, the tilt from the
/// specific force, and everything else that could have been learned while the estimate ran away is reset.
void FilterEngine::recover(const WheelMotion& wheels) {
  ++recoveries_;
  estimate_.stationary = estimate_.stuck = estimate_.wheel_speed_used = false;
  const double gravity_mps2 = planet_.gravity_n(state_.position).norm();
  const ErrorVector prior = dynamics_.priorVariance();
  const double level_variance = square(runaway_.levelStd_rad(gravity_mps2)) + prior(kAccelBias) / square(gravity_mps2);
  const Vector2 level = runaway_.level();
  state_.q_b_to_n = q_b_to_n_fromEuler(level.x(), level.y(), eulerFrom_q_b_to_n(state_.q_b_to_n).z());
  state_.v_eb_n = state_.q_b_to_n * Vector3(wheels.motion.forward_mps, 0.0, 0.0);
  state_.accel_bias_b.setZero();
  state_.imu_offset_b.setZero();
  vehicle_ = VehicleState{};
  for (int axis = 0; axis < 3; ++axis) {
    forget(kVelocity + axis, square(runaway_.fastest_mps()));
    forget(kAccelBias + axis, prior(kAccelBias + axis));
  }
  forget(kAttitude, level_variance);
  forget(kAttitude + 1, level_variance);
  P_(kAttitude + 2, kAttitude + 2) += level_variance;
  P_.diagonal().segment<3>(kPosition).array() += square(runaway_.wayBeyond_m());
  for (int state = kWheelScale; state < kYawScale; ++state) {  // the scale of the gyro is never estimated
    forget(state, prior(state));
  }
  slow_envelope_ = side_envelope_ = 0.0;
  lasting_slip_.reset();
  unexpected_slip_.begin();
  slow_slip_lasts_ = false;
  stuck_.reset();
}

}  // namespace slipnav
