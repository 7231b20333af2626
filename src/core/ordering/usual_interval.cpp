#include "slipnav/core/ordering/usual_interval.h"

#include <algorithm>
#include <numeric>

namespace slipnav {

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
  intervals_[count_ % kSpan] = interval_s;
  ++count_;
  if (count_ < kSpan) {
    insert(interval_s);
    return;
  }
  if (count_ == kSpan) {
    sorted_count_ = 0;  // from here on, means instead of single intervals
  }
  const double mean_s = std::accumulate(intervals_.begin(), intervals_.end(), 0.0) / static_cast<double>(kSpan);
  if (sorted_count_ == kMeans) {
    remove(means_[next_mean_]);
  }
  insert(mean_s);
  means_[next_mean_] = mean_s;
  next_mean_ = (next_mean_ + 1) % kMeans;
}

}  // namespace slipnav
