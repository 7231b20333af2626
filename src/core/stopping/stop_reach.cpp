#include "core/stopping/stop_reach.h"

namespace slipnav {

std::string whyNoEmergencyStop(StopMode mode, const StopListeners& listeners) {
  if (listeners.lock > 0) {
    return "";
  }
  if (mode != StopMode::kActive) {
    return "nobody listens to e_stop, and without stop.mode: active the rover need not obey cmd_vel";
  }
  return listeners.commands > 0 ? "" : "nobody listens to cmd_vel or e_stop";
}

std::string whyNoStop(StopMode mode, const StopListeners& listeners) {
  if (mode != StopMode::kActive) {
    return "without stop.mode: active a stop is only advised";
  }
  return listeners.commands > 0 ? "" : "nobody listens to cmd_vel";
}

}  // namespace slipnav
