#pragma once
/// Latency of estimates, by the wall clock. For diagnostics only. Times are of any monotonic clock.

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <deque>
#include <map>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Arrival times of the newest samples.
class Arrivals {
 public:
  void note(Nanoseconds stamp, double now_s);
  /// 0 if that is no longer known.
  double of(Nanoseconds stamp) const;

 private:
  struct Arrival {
    Nanoseconds stamp;
    double time_s;
  };
  std::deque<Arrival> newest_;
};

/// From the arrival of an IMU sample to the estimate at its stamp.
class LatencyMeter {
 public:
  /// Registers an estimate for a sample that arrived at `came_s`, unless that is not known (0). For a stamp
  /// registered twice the first time counts.
  void expect(Nanoseconds stamp, double came_s);
  /// The estimate has been published.
  void published(Nanoseconds stamp, double now_s);
  /// A new start: estimates still expected will not come.
  void restart() { expected_.clear(); }

  /// Reports the measurements since the last call.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  std::map<Nanoseconds, double> expected_;
  std::vector<double> latencies_s_;
};

}  // namespace slipnav
