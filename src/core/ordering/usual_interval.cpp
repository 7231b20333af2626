#include "slipnav/core/ordering/usual_interval.h"

#include <algorithm>
#include <numeric>

namespace slipnav {
namespace {

/// Relative to the usual interval: a sample that follows sooner has come at once with its predecessor.
constexpr double kAtOnce = 0.5;

}  // namespace

void UsualInterval::insert(double value_s) {
  const auto end = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_count_);
  const auto at = std::upper_bound(sorted_.begin(), end, value_s);
  std::copy_backward(at, end, end + 1);
  *at = value_s;
  ++sorted_count_;
}

void UsualInterval::remove(double value_s) {
  const auto end = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_count_);
  const auto at = std::lower_bound(sorted_.begin(), end, value_s);
  std::copy(at + 1, end, at);
  --sorted_count_;
}

void UsualInterval::add(double interval_s) {
  if (count_ < kSpan) {
    first_[count_] = interval_s;
    insert(interval_s);
    if (++count_ == kSpan) {
      takeFirst();
    }
    return;
  }
  follow(interval_s);
  if (at_once_ > kLongestBunch) {
    reset();
  }
}

/// From here on, means instead of single intervals. The first one tells which of them were bunches.
void UsualInterval::takeFirst() {
  sorted_count_ = 0;
  takeMean(std::accumulate(first_.begin(), first_.end(), 0.0) / static_cast<double>(kSpan));
  for (const double interval_s : first_) {
    follow(interval_s);
  }
}

void UsualInterval::follow(double interval_s) {
  for (std::size_t i = 0; i < begin_count_; ++i) {
    ++begins_[i].intervals;
    begins_[i].duration_s += interval_s;
  }
  ++at_once_;
  if (interval_s >= kAtOnce * value()) {
    meanSinceBegin();
    begins_[begin_count_++] = Begin();
    at_once_ = 0;
  }
}

/// Since the newest one that is long enough ago; older ones are no longer needed.
void UsualInterval::meanSinceBegin() {
  std::size_t newest = begin_count_;
  while (newest > 0 && begins_[newest - 1].intervals < kSpan) {
    --newest;
  }
  if (newest == 0) {
    return;
  }
  const Begin& since = begins_[newest - 1];
  takeMean(since.duration_s / static_cast<double>(since.intervals));
  std::copy(begins_.begin() + static_cast<std::ptrdiff_t>(newest) - 1,
            begins_.begin() + static_cast<std::ptrdiff_t>(begin_count_), begins_.begin());
  begin_count_ -= newest - 1;
}

void UsualInterval::takeMean(double mean_s) {
  if (sorted_count_ == kMeans) {
    remove(means_[next_mean_]);
  }
  insert(mean_s);
  means_[next_mean_] = mean_s;
  next_mean_ = (next_mean_ + 1) % kMeans;
}

}  // namespace slipnav
