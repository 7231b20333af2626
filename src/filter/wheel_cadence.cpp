#include "slipnav/filter/wheel_cadence.h"

#include <algorithm>

namespace slipnav {
namespace {

constexpr int kIntervalsToLearn = 4;
constexpr double kGain = 0.05;
constexpr double kHoleFactor = 1.5;

}  // namespace

void WheelCadence::restart(Nanoseconds stamp) {
  newest_ = stamp;
  intervals_ = 0;
  usual_s_ = 0.0;
}

void WheelCadence::add(Nanoseconds stamp) {
  const double interval_s = toSeconds(stamp - newest_);
  newest_ = stamp;
  if (interval_s > longest_s_) {
    return;
  }
  ++intervals_;
  usual_s_ += std::max(kGain, 1.0 / intervals_) * (interval_s - usual_s_);
}

bool WheelCadence::isHole(Nanoseconds from, Nanoseconds to) const {
  return intervals_ < kIntervalsToLearn || toSeconds(to - from) > kHoleFactor * usual_s_;
}

}  // namespace slipnav
