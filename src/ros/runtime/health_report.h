#pragma once
/// Alarms of a HealthMonitor as diagnostics.

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <cstdint>
#include <map>
#include <string>

#include "slipnav/core/navigation/health.h"

namespace slipnav {

/// How long an alarm remains a warning after it was last seen [s] of real time. Longer than between two reports, so
/// that none is missed; short, so that a fix shows immediately.
inline constexpr double kAlarmLifetime_s = 1.0;

/// Remembers when each alarm was last seen, in real time: where stamps stand still, alarms end nevertheless.
class HealthReport {
 public:
  /// Adds one line for each problem so far; those still present are a warning.
  /// @param now_s any monotonic clock
  void add(const HealthMonitor& health, double now_s, diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  struct Seen {
    std::uint64_t count = 0;
    double time_s = 0.0;
  };

  std::map<std::string, Seen> seen_;
};

}  // namespace slipnav
