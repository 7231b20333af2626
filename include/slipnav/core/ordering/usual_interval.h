#pragma once
/// The usual interval between samples of one source, robust against single stamps.
///
/// Running median of the mean over some successive intervals: the mean sees through stamps that bunch or scatter, the
/// median through losses. A mean begins and ends where samples stop coming at once, so that it is over whole bunches,
/// whatever their size. Every interval is used, so that it rises as well as falls.

#include <array>
#include <cstddef>

namespace slipnav {

/// Does not allocate.
class UsualInterval {
 public:
  /// Least number of intervals over which a mean is taken.
  static constexpr std::size_t kSpan = 16;
  /// Means over which the median is taken.
  static constexpr std::size_t kMeans = 65;
  /// More samples than this that come at once are not a bunch: they come at another rate.
  static constexpr std::size_t kLongestBunch = 64;

  void reset() { *this = UsualInterval(); }
  void add(double interval_s);

  /// 0 before the first interval; the median of the intervals while there are fewer than kSpan [s].
  double value() const { return sorted_count_ == 0 ? 0.0 : sorted_[sorted_count_ / 2]; }

  /// Whether there have been kSpan intervals.
  bool isKnown() const { return count_ >= kSpan; }

 private:
  /// Intervals since a sample that did not come at once with the one before.
  struct Begin {
    std::size_t intervals = 0;
    double duration_s = 0.0;
  };

  void insert(double value_s);
  void remove(double value_s);
  void takeMean(double mean_s);
  void takeFirst();
  void follow(double interval_s);
  void meanSinceBegin();

  std::array<double, kSpan> first_ = {};
  std::array<double, kMeans> means_ = {};     ///< in order of time, a ring
  std::array<double, kMeans> sorted_ = {};    ///< the same
  std::array<Begin, kSpan + 2> begins_ = {};  ///< oldest first: at most one has kSpan intervals or more
  std::size_t sorted_count_ = 0;
  std::size_t next_mean_ = 0;
  std::size_t begin_count_ = 0;
  std::size_t at_once_ = 0;  ///< samples since the newest begin
  std::size_t count_ = 0;    ///< of intervals
};

}  // namespace slipnav
