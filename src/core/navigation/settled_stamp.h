#pragma once
/// How long, by the wall clock, to wait for a silent sensor.
///
/// Results depend only on stamps: a sensor that is silent for longer than `filter.max_wait_s` is not waited
/// for. But in a recording played fast that is a few milliseconds, during which a message may simply still be on its
/// way. Hence silence counts only once it has also lasted a moment of real time. This never changes a result, it only
/// delays it while a sensor is silent.

#include "core/ordering/patience_limits.h"
#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// Newest stamp of one sensor that arrived at least the patience ago.
class SettledStamp {
 public:
  explicit SettledStamp(double patience_s = kPatience_s) : patience_s_(patience_s) {}

  /// @param now_s any monotonic clock
  void push(Nanoseconds stamp, double now_s) {
    if (stamp <= newest_ - kRestartBackstep) {
      arrivals_.clear();
      trusted_ = 0;
    }
    newest_ = stamp;
    arrivals_.push_back({stamp, now_s});
  }

  /// The stamp; 0 if nothing is old enough.
  Nanoseconds at(double now_s) {
    for (; !arrivals_.empty() && now_s - arrivals_.front().time_s >= patience_s_; arrivals_.pop_front()) {
      trusted_ = arrivals_.front().stamp;
    }
    return trusted_;
  }

 private:
  struct Arrival {
    Nanoseconds stamp = 0;
    double time_s = 0.0;
  };
  double patience_s_;
  RingQueue<Arrival> arrivals_;
  Nanoseconds newest_ = 0;
  Nanoseconds trusted_ = 0;
};

}  // namespace slipnav
