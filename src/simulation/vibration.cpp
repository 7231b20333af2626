#include "simulation/vibration.h"

#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav::sim {
namespace {

/// A rover at rest vibrates from its fans and the wind; 1σ of the velocity.
constexpr double kStandstillNoise_mps = 1e-4;

}  // namespace

Vibration::Vibration(const GroundParams& ground, double factor, double rate_hz, std::uint64_t seed)
    // offsets are independent from interval to interval; their first and second differences over the interval have the
    // deviations of the vibration at rest, and of the ground's effect on specific force and rate
    : offset_sigma_(std::sqrt(1.0 / 6.0) * factor * ground.vibration_mps2 / (rate_hz * rate_hz)),
      tremor_sigma_(std::sqrt(0.5) * factor * kStandstillNoise_mps / rate_hz),
      angle_sigma_(std::sqrt(0.5) * factor * ground.vibration_radps / rate_hz),
      stream_(seed, "vibration") {}

InertialMean Vibration::shake(const InertialMean& smooth, double dt_s, double speed_mps) {
  const Vector3 offset_before = offset_b_;
  const Vector3 velocity_before = velocity_b_;
  const Vector3 angle_before = angle_b_;
  const double part = speed_mps / kVibrationSpeed_mps;
  offset_b_ = std::hypot(part * offset_sigma_, tremor_sigma_) * stream_.normal3();
  velocity_b_ = (offset_b_ - offset_before) / dt_s;
  angle_b_ = part * angle_sigma_ * stream_.normal3();
  // the sensing axes rotate with the vibration
  const Quaternion q_smooth_to_shaken = quaternionFromRotationVector(-0.5 * (angle_before + angle_b_));
  return {q_smooth_to_shaken * smooth.f_ib_b + (velocity_b_ - velocity_before) / dt_s,
          q_smooth_to_shaken * smooth.omega_ib_b + (angle_b_ - angle_before) / dt_s};
}

}  // namespace slipnav::sim
