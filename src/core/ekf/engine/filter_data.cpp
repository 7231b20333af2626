#include "slipnav/core/ekf/engine/filter_data.h"

#include <algorithm>
#include <cmath>

namespace slipnav {

WheelMotion toWheelMotion(const WheelGeometry& geometry, const WheelSample& sample) {
  WheelMotion wheels;
  wheels.stamp = sample.stamp;
  wheels.motion = geometry.motion(sample);
  wheels.count = geometry.count();
  for (std::size_t i = 0; i < wheels.count; ++i) {
    wheels.circumferential_mps[i] = geometry.circumferentialSpeed(sample, i);
    wheels.largest_speed_mps = std::max(wheels.largest_speed_mps, std::abs(wheels.circumferential_mps[i]));
  }
  return wheels;
}

WheelMotion toWheelMotion(const SpeedSample& sample) {
  WheelMotion wheels;
  wheels.stamp = sample.stamp;
  wheels.motion.forward_mps = sample.forward_mps;
  wheels.largest_speed_mps = std::abs(sample.forward_mps);
  return wheels;
}

}  // namespace slipnav
