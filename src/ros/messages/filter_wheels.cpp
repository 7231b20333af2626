#include "ros/messages/filter_wheels.h"

#include <algorithm>
#include <utility>

namespace slipnav {
namespace {

/// [s] without a usable sample, or `filter.max_wheel_interval_s` if that is longer.
constexpr double kSilence_s = 0.5;

}  // namespace

FilterWheels::FilterWheels(const Config& config, std::function<void(const WheelMotion&)> use)
    : input_(config),
      watch_("wheels", std::max(kSilence_s, config.filter.max_wheel_interval_s)),
      use_(std::move(use)) {}

void FilterWheels::push(const WheelMotion& motion) {
  jumps_.push(motion, [this](const WheelMotion& passed) { sort(in_time_.push(passed)); });
}

bool FilterWheels::learn(const ContinuousTime& time) {
  if (time.steps().size() == in_time_.time().steps().size()) {
    return false;
  }
  sort(in_time_.learn(time));
  return true;
}

void FilterWheels::startNext() {
  for (const WheelMotion& wheels : sessions_.startNext()) {
    use_(wheels);
  }
}

void FilterWheels::sort(const std::vector<WheelMotion>& samples) {
  for (const WheelMotion& sample : samples) {
    for (const WheelMotion& wheels : sessions_.push(sample)) {
      use_(wheels);
    }
  }
}

}  // namespace slipnav
