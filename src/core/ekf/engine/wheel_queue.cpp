#include "slipnav/core/ekf/engine/wheel_queue.h"

#include <algorithm>

namespace slipnav {
namespace {

constexpr std::size_t kMaxWaiting = 4096;  // samples kept before the start

bool earlier(const WheelMotion& a, const WheelMotion& b) { return a.stamp < b.stamp; }

}  // namespace

void WheelQueue::clear() {
  samples_.clear();
  started_ = false;
  complete_until_ = 0;
}

bool WheelQueue::start(Nanoseconds stamp) {
  started_ = true;
  interval_.restart(stamp);
  bool at_start = false;
  while (!samples_.empty() && samples_.front().stamp <= stamp) {
    at_start = samples_.front().stamp == stamp;
    samples_.pop_front();
  }
  return at_start;
}

bool WheelQueue::push(const WheelMotion& wheels, Nanoseconds processed_until) {
  if (started_ && (wheels.stamp <= interval_.newest() || interval_.due(wheels.stamp) <= processed_until)) {
    return false;
  }
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (samples_[i].stamp == wheels.stamp) {
      return false;
    }
  }
  if (!started_ && samples_.size() >= kMaxWaiting) {
    samples_.pop_front();
  }
  samples_.insertSorted(wheels, earlier);
  return true;
}

void WheelQueue::assumeCompleteUpTo(Nanoseconds stamp) { complete_until_ = std::max(complete_until_, stamp); }

Nanoseconds WheelQueue::knownUntil() const {
  Nanoseconds known = interval_.newest();
  for (std::size_t i = 0; i < samples_.size() && !interval_.isHole(known, samples_[i].stamp); ++i) {
    known = samples_[i].stamp;
  }
  return std::max({known, complete_until_, interval_.quietUntil() - 1});
}

bool WheelQueue::hasUpTo(Nanoseconds stamp) const {
  return !samples_.empty() && interval_.due(samples_.front().stamp) <= stamp;
}

WheelMotion WheelQueue::take() {
  WheelMotion wheels = samples_.front();
  samples_.pop_front();
  const Nanoseconds due = interval_.due(wheels.stamp);
  interval_.add(wheels.stamp);
  wheels.stamp = due;
  return wheels;
}

}  // namespace slipnav
