#pragma once
/// Whether a stop that is commanded reaches the rover.

#include <cstddef>
#include <string>

#include "core/stopping/stop_params.h"

namespace slipnav {

/// How many nodes, recorders left out, listen to what can stop a rover.
struct StopListeners {
  std::size_t commands = 0;  ///< to cmd_vel
  std::size_t lock = 0;      ///< to e_stop, the lock of a command multiplexer
};

/// Why an emergency stop does not stop the rover, in words; "" when it does: somebody listens to the lock, or the mode
/// is `active`, in which the rover obeys cmd_vel, and somebody listens to that. In other modes nobody has said that the
/// rover does.
std::string whyNoEmergencyStop(StopMode mode, const StopListeners& listeners);

/// Why a stop for a zero update is not made by this supervisor although it decides on one, in words; "" when it is.
std::string whyNoStop(StopMode mode, const StopListeners& listeners);

}  // namespace slipnav
