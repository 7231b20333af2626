#include "core/navigation/wheel_sessions.h"

#include <algorithm>

namespace slipnav {
namespace {

constexpr std::size_t kMaxWaiting = 100000;

}  // namespace

std::vector<WheelMotion> WheelSessions::push(const WheelMotion& wheels) {
  if (wheels.stamp <= newest_ - kRestartBackstep) {
    newest_ = wheels.stamp;
    started_ = outdated_;
    outdated_ = false;
    waiting_.clear();
  }
  newest_ = std::max(newest_, wheels.stamp);
  if (outdated_) {
    return {};
  }
  if (started_) {
    return {wheels};
  }
  waiting_.push_back(wheels);
  if (waiting_.size() > kMaxWaiting) {
    waiting_.pop_front();
  }
  return {};
}

std::vector<WheelMotion> WheelSessions::startNext() {
  outdated_ = started_;
  started_ = true;
  const std::vector<WheelMotion> samples(waiting_.begin(), waiting_.end());
  waiting_.clear();
  return samples;
}

}  // namespace slipnav
