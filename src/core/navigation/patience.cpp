#include "core/navigation/patience.h"

#include <algorithm>

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
  while (!arrivals_.empty() && now_s - arrivals_.front().time_s >= patience_s_) {
    trusted_ = arrivals_.front().stamp;
    arrivals_.pop_front();
  }
  return trusted_;
}

void StepGate::restart() {
  held_.clear();
  newest_ = 0;
  trusted_ = TrustedStamp(patience_s_);
}

void StepGate::push(const InsStep& step, double now_s) {
  held_.push_back(step);
  if (step.state.stamp > newest_) {
    newest_ = step.state.stamp;
    trusted_.push(newest_, now_s);
  }
}

void StepGate::release(Nanoseconds wheels_known_until, double now_s, const std::function<void(const InsStep&)>& sink,
                       Nanoseconds others_decided_at) {
  const Nanoseconds trusted = trusted_.at(now_s);
  const Nanoseconds decided_at =
      max_wait_s_ ? std::min(others_decided_at, wheels_known_until + fromSeconds(*max_wait_s_)) : others_decided_at;
  const auto may_go = [decided_at, trusted](const InsStep& step) {
    const Nanoseconds end = step.state.stamp;
    return end < decided_at || end <= trusted;
  };
  while (!held_.empty() && may_go(held_.front())) {
    sink(held_.front());
    held_.pop_front();
  }
}

}  // namespace slipnav
