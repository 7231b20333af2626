#pragma once
/// The usual interval between samples of one source, robust against single stamps.
///
/// Running median of the mean over a few successive intervals: the mean sees through stamps that bunch or scatter, the
/// median through losses. Every interval is used, so that it rises as well as falls.

#include <array>
#include <cstddef>

namespace slipnav {

/// Does not allocate.
class UsualInterval {
 public:
  /// Intervals over which a mean is taken.
  static constexpr std::size_t kSpan = 16;
  /// Means over which the median is taken.
  static constexpr std::size_t kMeans = 65;

  void reset() { *this = UsualInterval(); }
  void add(double interval_s);

  /// 0 before the first interval; the median of the intervals while there are fewer than kSpan [s].
  double value() const { return sorted_count_ == 0 ? 0.0 : sorted_[sorted_count_ / 2]; }

  /// Whether there have been kSpan intervals.
  bool isKnown() const { return count_ >= kSpan; }

 private:
  void insert(double value_s);
  void remove(double value_s);

  std::array<double, kSpan> intervals_ = {};
  std::array<double, kMeans> means_ = {};   ///< in order of time, a ring
  std::array<double, kMeans> sorted_ = {};  ///< the same
  std::size_t sorted_count_ = 0;
  std::size_t next_mean_ = 0;
  std::size_t count_ = 0;  ///< of intervals
};

}  // namespace slipnav
