#include "slipnav/ros/patience.h"

namespace slipnav {

void TrustedStamp::push(Nanoseconds stamp, double now_s) {
  if (stamp <= newest_ - kRestartBackstep) {
    arrivals_.clear();
    trusted_ = 0;
  }
  newest_ = stamp;
  arrivals_.push_back({stamp, now_s});
}

Nanoseconds TrustedStamp::at(double now_s) {
  while (!arrivals_.empty() && now_s - arrivals_.front().time_s >= kPatience_s) {
    trusted_ = arrivals_.front().stamp;
    arrivals_.pop_front();
  }
  return trusted_;
}

void StepGate::release(Nanoseconds newest_wheels, double now_s, const std::function<void(const InsStep&)>& sink) {
  const auto may_go = [this, newest_wheels, now_s](const Held& held) {
    return !max_wait_s_ || held.step.state.stamp < newest_wheels + fromSeconds(*max_wait_s_) ||
           now_s - held.time_s >= kPatience_s;
  };
  while (!held_.empty() && may_go(held_.front())) {
    sink(held_.front().step);
    held_.pop_front();
  }
}

}  // namespace slipnav
