#include "slipnav/core/ekf/adaptation/slipping_speed.h"

#include <cmath>

namespace slipnav {
namespace {

constexpr double kMemory_s = 1.0;

}  // namespace

void SlippingSpeed::add(Nanoseconds stamp, double wheel_speed_mps) {
  while (!lowest_.empty() && std::abs(lowest_.back().speed_mps) >= std::abs(wheel_speed_mps)) {
    lowest_.pop_back();
  }
  lowest_.push_back({stamp, wheel_speed_mps});
  while (toSeconds(stamp - lowest_.front().stamp) > kMemory_s) {
    lowest_.pop_front();
  }
}

}  // namespace slipnav
