#pragma once
/// How long, by the wall clock, to wait for a silent sensor.
///
/// Results depend only on stamps: a sensor that is silent for longer than `filter.max_wait_s` is not waited
/// for. But in a recording played fast that is a few milliseconds, during which a message may simply still be on its
/// way. Hence silence counts only once it has also lasted a moment of real time. This never changes a result, it only
/// delays it while a sensor is silent.

#include <deque>
#include <functional>
#include <limits>
#include <optional>

#include "core/ordering/patience_limits.h"
#include "slipnav/core/ins/ins_engine.h"

namespace slipnav {

/// Newest stamp of one sensor that arrived at least the patience ago.
class TrustedStamp {
 public:
  explicit TrustedStamp(double patience_s = kPatience_s) : patience_s_(patience_s) {}

  /// @param now_s any monotonic clock
  void push(Nanoseconds stamp, double now_s);
  /// The stamp; 0 if nothing is old enough.
  Nanoseconds at(double now_s);

 private:
  struct Arrival {
    Nanoseconds stamp;
    double time_s;
  };
  double patience_s_;
  std::deque<Arrival> arrivals_;
  Nanoseconds newest_ = 0;
  Nanoseconds trusted_ = 0;
};

/// Holds mechanized steps back from the filter while earlier samples may still be on their way.
class StepGate {
 public:
  /// @param max_wait_s filter.max_wait_s; nothing if no wheel samples are used
  explicit StepGate(std::optional<double> max_wait_s, double patience_s = kPatience_s)
      : max_wait_s_(max_wait_s), patience_s_(patience_s), trusted_(patience_s) {}

  /// Drops held steps; steps that come again in their place need not wait again.
  void clear() { held_.clear(); }
  /// Forgets everything.
  void restart();
  void push(const InsStep& step, double now_s);

  /// Releases steps, in order.
  /// @param wheels_known_until wheel samples are known without a hole up to this stamp
  /// @param others_decided_at stamp of the IMU at which the filter stops waiting for others
  void release(Nanoseconds wheels_known_until, double now_s, const std::function<void(const InsStep&)>& sink,
               Nanoseconds others_decided_at = std::numeric_limits<Nanoseconds>::max());

 private:
  std::optional<double> max_wait_s_;
  double patience_s_;
  std::deque<InsStep> held_;
  Nanoseconds newest_ = 0;
  TrustedStamp trusted_;
};

}  // namespace slipnav
