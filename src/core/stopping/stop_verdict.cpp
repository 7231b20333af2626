#include "core/stopping/stop_verdict.h"

namespace slipnav {
namespace {

std::string dangerOf(const StopSigns& signs) {
  if (!signs.unheard.empty()) {
    return "emergency stop without effect: " + signs.unheard;
  }
  if (signs.ignored) {
    return "the rover keeps driving although it is told to stop";
  }
  if (!signs.not_kept.empty()) {
    return "emergency stop and override are not kept: " + signs.not_kept;
  }
  return signs.rivals.empty() ? "" : "more than one node publishes nav_state: " + signs.rivals;
}

std::string problemOf(const SupervisorStatus& status, StopMode mode, const StopSigns& signs) {
  if (status.emergency_stop) {
    return "emergency stop";
  }
  if (mode == StopMode::kOff) {
    return "";
  }
  if (signs.estimates_missing) {
    return "no estimates";
  }
  if (mode == StopMode::kActive && signs.commands_unheard) {
    return "nobody listens to cmd_vel";
  }
  if (signs.commands_silent) {
    return "cmd_vel_in is silent";
  }
  return status.forecasts_stale || signs.forecaster_silent ? "no forecasts: periodic stops" : "";
}

}  // namespace

StopVerdict judgeStops(const SupervisorStatus& status, StopMode mode, const StopSigns& signs) {
  const std::string danger = dangerOf(signs);
  if (!danger.empty()) {
    return {StopConcern::kDanger, danger};
  }
  const std::string problem = problemOf(status, mode, signs);
  return problem.empty() ? StopVerdict{StopConcern::kNone, status.reason} : StopVerdict{StopConcern::kProblem, problem};
}

const char* nameOf(StopState state) {
  switch (state) {
    case StopState::kDriving:
      return "driving";
    case StopState::kCountingDown:
      return "counting down";
    case StopState::kStopping:
      return "stopping";
    case StopState::kHolding:
      break;
  }
  return "holding";
}

}  // namespace slipnav
