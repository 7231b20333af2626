#include "core/navigation/look_ahead.h"

namespace slipnav {

void LookAhead::restart(Nanoseconds processed) {
  wheels_.clear();
  processed_ = processed;
  steps_.clear();
  told_ = 0;
}

void LookAhead::addStep(Nanoseconds end) {
  if (end > newestStep()) {
    steps_.push_back(end);
  }
}

void LookAhead::processed(Nanoseconds end) {
  processed_ = end;
  wheels_.erase(wheels_.begin(), wheels_.upper_bound(end));
  while (!steps_.empty() && steps_.front() <= end) {
    steps_.pop_front();
  }
}

Nanoseconds LookAhead::runUntil() const {
  if (steps_.empty()) {
    return wheels_.empty() ? processed_ + window_ : *wheels_.begin();
  }
  return steps_.front() + window_;  // after a gap this step alone may be longer than the window
}

}  // namespace slipnav
