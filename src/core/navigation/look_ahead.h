#pragma once
/// How far ahead of the filter mechanising is of use.
///
/// The next wheel sample will correct the state, and what was mechanised beyond it is then done again. So while that
/// sample is known, nothing beyond it is wanted. Otherwise the mechanisation may run ahead until the sample comes, or
/// counts as missing.

#include <deque>
#include <set>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Says up to which stamp Ins is to mechanise.
class LookAhead {
 public:
  explicit LookAhead(double max_wait_s) : window_(fromSeconds(max_wait_s + kMargin_s)) {}

  /// A new start; nothing is known.
  void restart(Nanoseconds processed);
  void addWheels(Nanoseconds stamp) { wheels_.insert(stamp); }
  /// A step that was there before is not noted again.
  void addStep(Nanoseconds end);
  /// The filter has come to the end of a step.
  void processed(Nanoseconds end);
  /// The steps that were not processed are void.
  void forgetSteps() { steps_.clear(); }

  /// No step is wanted beyond the first one that ends at or after this.
  Nanoseconds runUntil() const;

  /// Whether the mechanisation has used up what it was told last and is to be told anew.
  bool isStalled() const { return newestStep() >= told_ && runUntil() > told_; }
  void told(Nanoseconds run_until) { told_ = run_until; }

 private:
  static constexpr double kMargin_s = 1.0;

  Nanoseconds newestStep() const { return steps_.empty() ? processed_ : steps_.back(); }

  Nanoseconds window_;
  Nanoseconds processed_ = 0;
  Nanoseconds told_ = 0;
  std::deque<Nanoseconds> steps_;  ///< ends of those that are not processed
  std::set<Nanoseconds> wheels_;   ///< later than what is processed
};

}  // namespace slipnav
