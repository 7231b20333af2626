#pragma once
/// How long estimates take, by the wall clock. For diagnostics only. Times are of any clock that only runs forward.

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <deque>
#include <map>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// When the newest samples came.
class Arrivals {
 public:
  void note(Nanoseconds stamp, double now_s);
  /// 0 when that is not known any more.
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
  /// An estimate is going to be made of a sample that came at `came_s`, unless that is not known (0). Of a stamp that
  /// is told again the first telling counts.
  void expect(Nanoseconds stamp, double came_s);
  /// It has been published.
  void published(Nanoseconds stamp, double now_s);
  /// A new start: those that are still expected never come.
  void restart() { expected_.clear(); }

  /// Adds what has been measured since the last call.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  std::map<Nanoseconds, double> expected_;
  std::vector<double> latencies_s_;
};

}  // namespace slipnav
