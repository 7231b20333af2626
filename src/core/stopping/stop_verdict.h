#pragma once
/// What the operator has to know about the stops, in words, the worst first.

#include <string>

#include "core/stopping/stop_params.h"
#include "core/stopping/stop_supervisor.h"

namespace slipnav {

/// What tells that stops are not what they should be.
struct StopSigns {
  std::string unheard;   ///< why an emergency stop that is set does not reach the rover; "" when it does
  bool ignored = false;  ///< the rover drives on although it is told to stop
  std::string not_kept;  ///< why emergency stop and override would not survive a restart; "" when they would
  std::string rivals;    ///< the nodes that publish estimates, if they are more than one
  bool estimates_missing = false;
  bool commands_unheard = false;  ///< nobody listens to cmd_vel
  bool commands_silent = false;
  bool forecaster_silent = false;
};

/// In the order of their weight.
enum class StopConcern { kNone, kProblem, kDanger };

struct StopVerdict {
  StopConcern concern = StopConcern::kNone;
  std::string words;
};

/// A danger is what takes an emergency stop its meaning, now or after a restart.
StopVerdict judgeStops(const SupervisorStatus& status, StopMode mode, const StopSigns& signs);

/// In words for log and diagnostics.
const char* nameOf(StopState state);

}  // namespace slipnav
