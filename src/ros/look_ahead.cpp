#include "slipnav/ros/look_ahead.h"

namespace slipnav {

void LookAhead::restart(Nanoseconds processed) {
  wheels_.clear();
  processed_ = processed;
  newest_step_ = processed;
  told_ = 0;
}

void LookAhead::processed(Nanoseconds end) {
  processed_ = end;
  wheels_.erase(wheels_.begin(), wheels_.upper_bound(end));
}

Nanoseconds LookAhead::runUntil() const {
  const bool all_processed = newest_step_ <= processed_;
  return all_processed && !wheels_.empty() ? *wheels_.begin() : processed_ + window_;
}

}  // namespace slipnav
