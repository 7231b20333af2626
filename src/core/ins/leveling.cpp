#include "core/ins/leveling.h"

#include <cmath>
#include <stdexcept>

#include "slipnav/core/base/rotation.h"

namespace slipnav {

Vector2 levelAtRest(const Vector3& f) {
  return {std::atan2(-f.y(), -f.z()), std::atan2(f.x(), std::hypot(f.y(), f.z()))};
}

Vector3 reactionToGravityOnTheMove(const std::vector<ImuSample>& samples, double first_speed_mps,
                                   double last_speed_mps) {
  if (samples.size() < 2) {
    throw std::invalid_argument("leveling on the move needs at least two IMU samples");
  }
  Quaternion q_b_to_b0 = Quaternion::Identity();
  Vector3 impulse_b0 = Vector3::Zero();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double dt_s = toSeconds(samples[i].stamp - samples[i - 1].stamp);
    const Vector3 half_turn = 0.5 * dt_s * samples[i].omega_ib_b;
    q_b_to_b0 = q_b_to_b0 * quaternionFromRotationVector(half_turn);
    impulse_b0 += dt_s * (q_b_to_b0 * samples[i].f_ib_b);
    q_b_to_b0 = q_b_to_b0 * quaternionFromRotationVector(half_turn);
  }
  const Vector3 speed_change_b0 = q_b_to_b0 * Vector3(last_speed_mps, 0.0, 0.0) - Vector3(first_speed_mps, 0.0, 0.0);
  return (impulse_b0 - speed_change_b0) / toSeconds(samples.back().stamp - samples.front().stamp);
}

}  // namespace slipnav
