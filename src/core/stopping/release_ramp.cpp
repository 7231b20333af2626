#include "core/stopping/release_ramp.h"

#include <algorithm>

namespace slipnav {

void ReleaseRamp::begin(Nanoseconds stamp) {
  stamp_ = stamp;
  factor_ = 0.0;
}

VelocityCommand ReleaseRamp::shorten(const VelocityCommand& in, Nanoseconds stamp, double acceleration_mps2,
                                     double angular_acceleration_radps2) {
  if (in.isZero()) {
    end();
  }
  if (factor_ >= 1.0) {
    return in;
  }
  const double elapsed_s = std::max(0.0, toSeconds(stamp - stamp_));
  stamp_ = stamp;
  const double ramp_s =
      std::max(in.linear_mps.norm() / acceleration_mps2, in.angular_radps.norm() / angular_acceleration_radps2);
  factor_ = std::min(1.0, factor_ + elapsed_s / ramp_s);
  return factor_ >= 1.0 ? in : VelocityCommand{factor_ * in.linear_mps, factor_ * in.angular_radps};
}

}  // namespace slipnav
