#include "core/navigation/mechanization_limit.h"

namespace slipnav {

void MechanizationLimit::restart(Nanoseconds processed) {
  wheels_.clear();
  processed_ = processed;
  steps_.clear();
  told_ = 0;
}

void MechanizationLimit::addStep(Nanoseconds end) {
  if (end > newestStep()) {
    steps_.push_back(end);
  }
}

void MechanizationLimit::processed(Nanoseconds end) {
  processed_ = end;
  while (!wheels_.empty() && wheels_.front() <= end) {
    wheels_.pop_front();
  }
  while (!steps_.empty() && steps_.front() <= end) {
    steps_.pop_front();
  }
}

Nanoseconds MechanizationLimit::runUntil() const {
  if (steps_.empty()) {
    return wheels_.empty() ? processed_ + window_ : wheels_.front();
  }
  return steps_.front() + window_;  // after a gap this step alone may be longer than the window
}

}  // namespace slipnav
