#include "core/stopping/stop_ramp.h"

#include <algorithm>

namespace slipnav {

void StopRamp::begin(Nanoseconds stamp, double linear_speed_mps) {
  stamp_ = stamp;
  factor_ = 1.0;
  linear_speed_mps_ = linear_speed_mps;
}

VelocityCommand StopRamp::shorten(const VelocityCommand& in, Nanoseconds stamp) {
  const double linear_mps = in.linear_mps.norm();
  const double angular_radps = in.angular_radps.norm();
  const double elapsed_s = std::max(0.0, toSeconds(stamp - stamp_));
  stamp_ = stamp;
  if (in.isZero()) {
    factor_ = 0.0;
    return {};
  }
  // the shorter of the two ramps would be too steep for the other motion
  const double ramp_s = std::max(linear_mps / deceleration_mps2_, angular_radps / angular_deceleration_radps2_);
  factor_ = std::max(0.0, factor_ - elapsed_s / ramp_s);
  const double linear_factor = linear_mps > 0.0 ? std::min(factor_, linear_speed_mps_ / linear_mps) : factor_;
  linear_speed_mps_ = linear_factor * linear_mps;
  return {linear_factor * in.linear_mps, factor_ * in.angular_radps};
}

}  // namespace slipnav
