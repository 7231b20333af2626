#include "slipnav/core/navigation/direction_check.h"

#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

constexpr Nanoseconds kShortestRest = kSecond;
/// The body may move before the wheels are seen to: only what is older counts as rest.
constexpr Nanoseconds kDoubtfulRest = kSecond / 2;
constexpr Nanoseconds kKeptRest = 2 * kSecond;
constexpr Nanoseconds kIntegration = 3 * kSecond / 2;
/// Slower starts are indistinguishable from residual gravity and biases.
constexpr double kLeastSpeed_mps = 0.2;
/// Relative to the wheel speed; between 0 and 1 is slip.
constexpr double kOpposite = -0.5;

}  // namespace

void DirectionCheck::push(const ImuSample& sample) {
  if (phase_ == Phase::kAtRest) {
    rest_.push_back(sample);
    while (rest_.front().stamp < sample.stamp - kKeptRest) {
      rest_.pop_front();
    }
  } else if (phase_ == Phase::kStarting) {
    integrate(sample);
    if (sample.stamp - start_ >= kIntegration) {
      judge();
    }
  }
}

void DirectionCheck::push(const WheelMotion& wheels) {
  wheel_speed_mps_ = wheels.motion.forward_mps;
  has_sign_ = has_sign_ || wheel_speed_mps_ < -rest_speed_mps_;
  const bool at_rest = wheels.largest_speed_mps <= rest_speed_mps_;
  if (at_rest && phase_ != Phase::kAtRest) {
    phase_ = Phase::kAtRest;
    rest_since_ = wheels.stamp;
    rest_.clear();
  } else if (!at_rest && phase_ == Phase::kAtRest) {
    phase_ = Phase::kMoving;
    if (wheels.stamp - rest_since_ >= kShortestRest) {
      begin(wheels.stamp);
    }
  }
}

void DirectionCheck::begin(Nanoseconds stamp) {
  reference_ = ImuSample{};
  double n = 0.0;
  std::deque<ImuSample> doubtful;
  for (const ImuSample& sample : rest_) {
    if (sample.stamp > stamp - kDoubtfulRest) {
      doubtful.push_back(sample);
      continue;
    }
    reference_.f_ib_b += sample.f_ib_b;
    reference_.omega_ib_b += sample.omega_ib_b;
    n += 1.0;
    integrated_until_ = sample.stamp;
  }
  if (n == 0.0) {
    return;
  }
  reference_.f_ib_b /= n;
  reference_.omega_ib_b /= n;
  phase_ = Phase::kStarting;
  start_ = stamp;
  q_b_to_rest_ = Quaternion::Identity();
  velocity_ = Vector3::Zero();
  for (const ImuSample& sample : doubtful) {
    integrate(sample);
  }
}

void DirectionCheck::integrate(const ImuSample& sample) {
  const double dt_s = toSeconds(sample.stamp - integrated_until_);
  integrated_until_ = sample.stamp;
  q_b_to_rest_ = q_b_to_rest_ * quaternionFromRotationVector(dt_s * (sample.omega_ib_b - reference_.omega_ib_b));
  velocity_ += dt_s * (q_b_to_rest_ * sample.f_ib_b - reference_.f_ib_b);
}

void DirectionCheck::judge() {
  phase_ = Phase::kMoving;
  if (std::abs(wheel_speed_mps_) >= kLeastSpeed_mps) {
    contradicts_ = velocity_.x() / wheel_speed_mps_ < kOpposite;
  }
}

}  // namespace slipnav
