#pragma once
/// A stop supervisor with the stamps that it gets, and the ways into each of its states.

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/stopping/stop_supervisor.h"

namespace slipnav::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Nanoseconds kInterval = 100'000'000;
inline constexpr double kSpeed_mps = 0.8;

inline constexpr StopState kD = StopState::kDriving;
inline constexpr StopState kC = StopState::kCountingDown;
inline constexpr StopState kS = StopState::kStopping;
inline constexpr StopState kH = StopState::kHolding;

inline VelocityCommand driveOn() { return {{kSpeed_mps, 0.0, 0.0}, {0.0, 0.0, 0.2}}; }

inline bool equal(const VelocityCommand& a, const VelocityCommand& b) {
  return a.linear_mps == b.linear_mps && a.angular_radps == b.angular_radps;
}

/// A supervisor and the stamps that it gets.
class Rig {
 public:
  explicit Rig(const std::string& mode, double max_hold_s = 3.0) : supervisor(paramsOf(mode, max_hold_s)) {}

  static StopParams paramsOf(const std::string& mode, double max_hold_s) {
    StopParams params;
    params.mode = mode;
    params.max_hold_s = max_hold_s;
    return params;
  }

  void moving() { observe(kSpeed_mps, 0.1, false, false); }
  void standing(double speed_std_mps = 0.1) { observe(0.0, speed_std_mps, true, true); }
  void wheelsStandOnly() { observe(0.1, 0.1, false, true); }

  /// Observes for so long what `observation` does.
  void during(double duration_s, const std::function<void()>& observation) {
    for (Nanoseconds end = stamp + fromSeconds(duration_s); stamp < end;) {
      observation();
    }
  }

  void forecast(double time_to_stop_s, double kept_s = 0.0) { supervisor.setForecast({stamp, time_to_stop_s, kept_s}); }
  StopState state() const { return supervisor.status().state; }
  VelocityCommand drive() { return supervisor.command(driveOn()); }

  StopSupervisor supervisor;
  Nanoseconds stamp = fromSeconds(1000.0);

 private:
  void observe(double forward_mps, double speed_std_mps, bool stationary, bool wheels_at_rest) {
    stamp += kInterval;
    supervisor.observe({stamp, forward_mps, speed_std_mps, stationary, true, wheels_at_rest});
  }
};

/// Every state that there is, with how to get there. Ten seconds have passed since the begin.
struct Situation {
  const char* name;
  StopState state;
  std::function<void(Rig&)> reach;
};

inline void driveTenSeconds(Rig& rig) {
  for (int i = 0; i < 10; ++i) {
    rig.during(1.0, [&rig] { rig.moving(); });
    rig.forecast(kInfinity);
    rig.drive();
  }
}

inline std::vector<Situation> situations() {
  return {{"no estimates so far", StopState::kDriving, [](Rig&) {}},
          {"driving", StopState::kDriving, driveTenSeconds},
          {"counting down", StopState::kCountingDown,
           [](Rig& rig) {
             driveTenSeconds(rig);
             rig.forecast(6.0);
           }},
          {"stopping", StopState::kStopping,
           [](Rig& rig) {
             driveTenSeconds(rig);
             rig.forecast(0.0);
           }},
          {"holding", StopState::kHolding, [](Rig& rig) {
             driveTenSeconds(rig);
             rig.forecast(0.0);
             rig.during(2.0, [&rig] {
               rig.moving();
               rig.drive();
             });
             rig.standing();
           }}};
}

}  // namespace slipnav::test
