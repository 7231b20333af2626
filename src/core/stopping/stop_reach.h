#pragma once
/// Whether a commanded stop reaches the rover.

#include <cstddef>
#include <string>

#include "core/stopping/stop_params.h"

namespace slipnav {

/// How many nodes, not counting recorders, listen to topics that can stop a rover.
struct StopListeners {
  std::size_t commands = 0;  ///< to cmd_vel
  std::size_t lock = 0;      ///< to e_stop, the lock of a command multiplexer
};

/// Why an emergency stop does not stop the rover, in words; "" if it does: somebody listens to the lock, or the mode
/// is `active`, in which the rover obeys cmd_vel, and somebody listens to that. In other modes there is no evidence
/// that the rover does.
std::string whyNoEmergencyStop(StopMode mode, const StopListeners& listeners);

/// Why this supervisor does not execute a stop for a zero update that it decides on, in words; "" if it does.
std::string whyNoStop(StopMode mode, const StopListeners& listeners);

}  // namespace slipnav
