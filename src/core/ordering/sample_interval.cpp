#include "slipnav/core/ordering/sample_interval.h"

namespace slipnav {
namespace {

constexpr int kIntervalsToLearn = 4;
constexpr double kGain = 0.05;
constexpr double kHoleFactor = 1.5;
constexpr double kQuietFraction = 0.9;  // of the shortest interval

}  // namespace

void SampleInterval::restart(Nanoseconds stamp) {
  newest_ = stamp;
  intervals_ = 0;
  usual_s_ = 0.0;
  shortest_s_ = longest_s_;
}

void SampleInterval::add(Nanoseconds stamp) {
  const double interval_s = toSeconds(stamp - newest_);
  newest_ = stamp;
  if (interval_s > longest_s_) {
    return;
  }
  ++intervals_;
  usual_s_ += std::max(kGain, 1.0 / intervals_) * (interval_s - usual_s_);
  shortest_s_ = std::min(interval_s, shortest_s_ + kGain * (interval_s - shortest_s_));
}

bool SampleInterval::isLearned() const { return intervals_ >= kIntervalsToLearn; }

bool SampleInterval::isHole(Nanoseconds from, Nanoseconds to) const {
  return !isLearned() || toSeconds(to - from) > kHoleFactor * usual_s_;
}

Nanoseconds SampleInterval::quietUntil() const {
  return isLearned() ? newest_ + fromSeconds(kQuietFraction * shortest_s_) : newest_;
}

}  // namespace slipnav
