#pragma once
/// How regularly the samples of one sensor arrive, and hence where one may be missing because it is still on its way,
/// and for how long after one the next is not due.
///
/// Learned from the samples in the order of processing, so that it depends only on stamps.

#include <algorithm>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Running mean and running minimum of the interval between samples.
class SampleInterval {
 public:
  /// @param longest_s a longer interval is an outage, and is not learned from
  explicit SampleInterval(double longest_s) : longest_s_(longest_s) {}

  /// Nothing is known about what comes after `stamp`.
  void restart(Nanoseconds stamp);

  /// The next sample in the order of stamps.
  void add(Nanoseconds stamp);

  /// Stamp of the newest sample, or of the restart.
  Nanoseconds newest() const { return newest_; }

  /// Whether the usual interval is known.
  bool isLearned() const;

  /// Whether a sample may be missing between two stamps; always true until the usual interval is known.
  bool isHole(Nanoseconds from, Nanoseconds to) const;

  /// No sample is due before this. One that arrives earlier anyway counts as if it ended here, so that there is no need
  /// to wait until then. Equals newest() until the usual interval is known.
  Nanoseconds quietUntil() const;

  /// When the sample with this stamp, later than newest(), counts.
  Nanoseconds due(Nanoseconds stamp) const { return std::max(stamp, quietUntil()); }

 private:
  double longest_s_;
  Nanoseconds newest_ = 0;
  int intervals_ = 0;
  double usual_s_ = 0.0;     ///< running mean
  double shortest_s_ = 0.0;  ///< running minimum: rises slowly, falls at once
};

}  // namespace slipnav
