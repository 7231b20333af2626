#pragma once
/// How regularly wheel samples come, and hence where one is missing: it may still be on its way.
///
/// Learned from the samples in the order in which they are processed, so that it depends on stamps alone.

#include "slipnav/types.h"

namespace slipnav {

/// Running mean of the interval between wheel samples.
class WheelCadence {
 public:
  /// @param longest_s a longer interval is an outage, from which nothing is learned
  explicit WheelCadence(double longest_s) : longest_s_(longest_s) {}

  /// Nothing is known of what comes after `stamp`.
  void restart(Nanoseconds stamp);

  /// The next sample in the order of stamps.
  void add(Nanoseconds stamp);

  /// Stamp of the newest sample, or of the restart.
  Nanoseconds newest() const { return newest_; }

  /// Whether a sample may be missing between two stamps; always true until the usual interval is known.
  bool isHole(Nanoseconds from, Nanoseconds to) const;

 private:
  double longest_s_;
  Nanoseconds newest_ = 0;
  int intervals_ = 0;
  double usual_s_ = 0.0;  ///< running mean
};

}  // namespace slipnav
