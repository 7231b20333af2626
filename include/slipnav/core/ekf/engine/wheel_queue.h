#pragma once
/// The wheel samples that the filter has yet to process, in the order of their stamps, and up to when they are known.

#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ordering/sample_interval.h"

namespace slipnav {

/// Sorts samples. Which of them count, and when, depends only on stamps and on what was taken before.
class WheelQueue {
 public:
  /// @param longest_interval_s a longer interval between samples is an outage
  explicit WheelQueue(double longest_interval_s) : interval_(longest_interval_s) {}

  /// Drops everything; samples wait for a start.
  void clear();

  /// Drops what is not later than `stamp`, from which everything counts.
  /// @return whether a sample had exactly that stamp: the next interval is then known from its beginning
  bool start(Nanoseconds stamp);

  /// @param processed_until anything earlier is too late, once there was a start
  /// @return false for a sample that is too late or repeated
  bool push(const WheelMotion& wheels, Nanoseconds processed_until);

  /// Declares that no sample up to `stamp` is still to come.
  void assumeCompleteUpTo(Nanoseconds stamp);

  /// The stamp up to which samples are known without a hole, or none is due.
  Nanoseconds knownUntil() const;

  /// Whether the next sample counts at `stamp` or before.
  bool hasUpTo(Nanoseconds stamp) const;

  /// Takes that sample; its stamp becomes the time at which it counts.
  WheelMotion take();

 private:
  RingQueue<WheelMotion> samples_;
  SampleInterval interval_;  ///< of those taken
  bool started_ = false;
  Nanoseconds complete_until_ = 0;
};

}  // namespace slipnav
