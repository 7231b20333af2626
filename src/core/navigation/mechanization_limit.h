#pragma once
/// How far ahead of the filter it makes sense to mechanize.
///
/// The next wheel sample will correct the state, and anything mechanized beyond it must be redone. So while that
/// sample is known, nothing beyond it is wanted. Otherwise the mechanization may run ahead until the sample arrives, or
/// counts as missing.

#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// Decides up to which stamp Ins mechanizes.
class MechanizationLimit {
 public:
  explicit MechanizationLimit(double max_wait_s) : window_(fromSeconds(max_wait_s + kMargin_s)) {}

  /// A new start; nothing is known.
  void restart(Nanoseconds processed);
  void addWheels(Nanoseconds stamp) {
    wheels_.insertSorted(stamp, [](Nanoseconds a, Nanoseconds b) { return a < b; });
  }
  /// A step that was already there is not added again.
  void addStep(Nanoseconds end);
  /// The filter has reached the end of a step.
  void processed(Nanoseconds end);
  /// The unprocessed steps are void.
  void forgetSteps() { steps_.clear(); }

  /// No step is wanted beyond the first one that ends at or after this.
  Nanoseconds runUntil() const;

  /// Whether the mechanization has used up its last limit and needs a new one.
  bool isStalled() const { return newestStep() >= told_ && runUntil() > told_; }
  void told(Nanoseconds run_until) { told_ = run_until; }

 private:
  static constexpr double kMargin_s = 1.0;

  Nanoseconds newestStep() const { return steps_.empty() ? processed_ : steps_.back(); }

  Nanoseconds window_;
  Nanoseconds processed_ = 0;
  Nanoseconds told_ = 0;
  RingQueue<Nanoseconds> steps_;   ///< ends of unprocessed steps
  RingQueue<Nanoseconds> wheels_;  ///< later than the processed ones, sorted
};

}  // namespace slipnav
