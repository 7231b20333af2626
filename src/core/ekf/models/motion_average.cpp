#include "slipnav/core/ekf/models/motion_average.h"

#include <algorithm>

namespace slipnav {

void MotionAverage::restart(Nanoseconds start) {
  start_ = start;
  integral_ = BodyMotion{};
}

double MotionAverage::add(const InsStep& step, const Vector3& v_eb_b, Nanoseconds from, Nanoseconds to) {
  const double overlap_s = toSeconds(std::min(to, step.state.stamp) - std::max(from, step.start));
  if (overlap_s <= 0.0) {
    return 0.0;
  }
  integral_.duration_s += overlap_s;
  integral_.v_eb_b += overlap_s * v_eb_b;
  integral_.omega_ib_b += overlap_s * step.omega_ib_b;
  return overlap_s;
}

std::optional<BodyMotion> MotionAverage::mean() const {
  if (integral_.duration_s <= 0.0) {
    return std::nullopt;
  }
  return BodyMotion{integral_.duration_s, integral_.v_eb_b / integral_.duration_s,
                    integral_.omega_ib_b / integral_.duration_s};
}

}  // namespace slipnav
