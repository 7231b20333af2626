#include "slipnav/core/sensors/wheel_monitor.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

/// Of the first `n` values.
double medianOf(std::array<double, kMaxWheels> values, std::size_t n) {
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::sort(values.begin(), end);
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

}  // namespace

void WheelMonitorParams::visit(ParameterVisitor& v) {
  v.number("max_speed_mps", max_speed_mps, {0.0, 100.0},
           "a faster circumferential speed is a reading error: the message is rejected [m/s]");
  v.number("difference_mps", difference_mps, {0.0, 100.0},
           "a wheel that differs from the others by more than this plus the next is suspect [m/s]");
  v.number("difference_ratio", difference_ratio, {0.0, 100.0}, "fraction of the vehicle's speed that is added to it");
  v.number("time_s", time_s, {0.0, 1e3},
           "a wheel that is suspect for this long is excluded until it has agreed as long [s]");
}

WheelMonitor::WheelMonitor(const WheelMonitorParams& params, const std::vector<WheelParams>& wheels) : params_(params) {
  for (const WheelParams& wheel : wheels) {
    y_right_m_.push_back(-wheel.y_m);
  }
}

void WheelMonitor::reset() {
  faulty_ = {};
  changing_since_ = {};
}

void WheelMonitor::add(Nanoseconds stamp, const std::array<double, kMaxWheels>& speed_mps, double yaw_rate_radps) {
  std::array<double, kMaxWheels> forward_mps = {};
  for (std::size_t i = 0; i < count(); ++i) {
    forward_mps[i] = speed_mps[i] + yaw_rate_radps * y_right_m_[i];
  }
  const double median_mps = medianOf(forward_mps, count());
  const double limit_mps = params_.difference_mps + params_.difference_ratio * std::abs(median_mps);
  double sum = 0.0;
  double sound = 0.0;
  for (std::size_t i = 0; i < count(); ++i) {
    const bool suspect = std::abs(forward_mps[i] - median_mps) > limit_mps;
    if (suspect == faulty_[i]) {
      changing_since_[i] = 0;
    } else if (changing_since_[i] == 0) {
      changing_since_[i] = stamp;
    } else if (toSeconds(stamp - changing_since_[i]) >= params_.time_s) {
      faulty_[i] = suspect;
      changing_since_[i] = 0;
    }
    sum += faulty_[i] ? 0.0 : forward_mps[i];
    sound += faulty_[i] ? 0.0 : 1.0;
  }
  sound_speed_mps_ = sum / std::max(sound, 1.0);
}

std::size_t WheelMonitor::faultyCount() const {
  return static_cast<std::size_t>(std::count(faulty_.begin(), faulty_.end(), true));
}

}  // namespace slipnav
