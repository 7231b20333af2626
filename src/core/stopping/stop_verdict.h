#pragma once
/// What the operator has to know about the stops, in words, worst first.

#include <string>

#include "core/stopping/stop_params.h"
#include "core/stopping/stop_supervisor.h"

namespace slipnav {

/// Signs that stops do not work as they should.
struct StopSigns {
  std::string unheard;   ///< why an active emergency stop does not reach the rover; "" if it does
  bool ignored = false;  ///< the rover keeps driving although it is told to stop
  std::string not_kept;  ///< why emergency stop and override would not survive a restart; "" if they would
  std::string rivals;    ///< the nodes that publish estimates, if there is more than one
  bool estimates_missing = false;
  bool commands_unheard = false;  ///< nobody listens to cmd_vel
  bool commands_silent = false;
  bool forecaster_silent = false;
};

/// In order of severity.
enum class StopConcern { kNone, kProblem, kDanger };

/// The most severe concern, and what to tell the operator.
struct StopVerdict {
  StopConcern concern = StopConcern::kNone;
  std::string words;
};

/// A danger is what makes an emergency stop ineffective, now or after a restart.
StopVerdict judgeStops(const SupervisorStatus& status, StopMode mode, const StopSigns& signs);

/// In words for log and diagnostics.
const char* nameOf(StopState state);

}  // namespace slipnav
