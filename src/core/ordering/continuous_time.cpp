#include "core/ordering/continuous_time.h"

#include <algorithm>

namespace slipnav {
namespace {

bool hasBegunAgain(Nanoseconds stamp, Nanoseconds first, Nanoseconds newest) {
  return stamp <= newest - kRestartBackstep && (stamp <= newest - kLongestSetBack || stamp <= first + kBeginning);
}

}  // namespace

Nanoseconds ContinuousTime::add(Nanoseconds stamp) {
  if (newest_ != 0 && hasBegunAgain(stamp, first_, newest_)) {
    *this = ContinuousTime();
  } else if (newest_ != 0 && stamp <= newest_ - kRestartBackstep) {
    const Nanoseconds before = toContinuous(newest_, steps_.size());
    const Nanoseconds interval = fromSeconds(usual_.value());
    steps_.push_back({before + interval / 2, before + interval - stamp});
    newest_ = stamp;
    return before + interval;
  }
  first_ = newest_ == 0 ? stamp : first_;
  if (newest_ != 0 && stamp > newest_) {
    usual_.add(toSeconds(stamp - newest_));
  }
  newest_ = std::max(newest_, stamp);
  return toContinuous(stamp, steps_.size());
}

Nanoseconds ContinuousTime::toContinuous(Nanoseconds stamp, std::size_t steps) const {
  const std::size_t known = std::min(steps, steps_.size());
  return known == 0 ? stamp : stamp + steps_[known - 1].offset;
}

Nanoseconds ContinuousTime::toClock(Nanoseconds continuous) const {
  const auto step =
      std::find_if(steps_.rbegin(), steps_.rend(), [continuous](const ClockStep& s) { return s.begin <= continuous; });
  return step == steps_.rend() ? continuous : continuous - step->offset;
}

std::optional<double> ContinuousTime::newestStep_s() const {
  if (steps_.empty()) {
    return std::nullopt;
  }
  return toSeconds(steps_.back().offset - (steps_.size() > 1 ? steps_[steps_.size() - 2].offset : 0));
}

void StepCount::add(Nanoseconds stamp) {
  const bool begins = newest_ == 0 || hasBegunAgain(stamp, first_, newest_);
  if (newest_ != 0 && stamp <= newest_ - kRestartBackstep) {
    ++all_;
    steps_ = begins ? 0 : steps_ + 1;
    newest_ = stamp;
  }
  first_ = begins ? stamp : first_;
  newest_ = std::max(newest_, stamp);
}

}  // namespace slipnav
