#include "core/stopping/stop_params.h"

namespace slipnav {

void StopParams::visit(ParameterVisitor& v) {
  v.choice("mode", mode, {"off", "advise", "active"},
           "off: no decisions; advise: commands pass unchanged, stops are recommended; active: the rover is "
           "stopped");
  v.number(
      "deceleration_mps2", deceleration_mps2, {0.01, 100.0},
      "limit on the deceleration of the commanded speed when the supervisor stops the rover, and on the acceleration "
      "when it releases it [m/s²]");
  v.number("angular_deceleration_radps2", angular_deceleration_radps2, {0.01, 100.0},
           "the same for the commanded turn [rad/s²]");
  v.number("max_stop_s", max_stop_s, {0.1, 600.0},
           "longest time from the start of a stop to standstill; afterwards commands pass again [s]");
  v.number("max_hold_s", max_hold_s, {0.1, 600.0}, "longest time at standstill [s]");
  v.number("converged_speed_std_mps", converged_speed_std_mps, {1e-7, 1.0},
           "a hold ends when the 1σ of the velocity, mean over the axes, is below this [m/s]");
  v.integer("min_zero_updates", min_zero_updates, {1, 100000}, "and this many zero updates were accepted");
  v.number("countdown_s", countdown_s, {0.0, 3600.0}, "how long before it begins a stop is announced [s]");
  v.number("no_stop_due_s", no_stop_due_s, {1.0, 3600.0},
           "largest value of stop_cmd, used when no stop is due: a node that counts down takes infinity for the "
           "end of the countdown [s]");
  v.number("min_drive_s", min_drive_s, {0.0, 3600.0}, "shortest drive between two stops [s]");
  v.number("forecast_timeout_s", forecast_timeout_s, {0.5, 3600.0},
           "without a new forecast for this long while driving, stops become periodic; longer than the window if a "
           "forecast is made once per window [s]");
  v.number("fallback_interval_s", fallback_interval_s, {1.0, 3600.0}, "drive between those periodic stops [s]");
  v.number("slide_after_s", slide_after_s, {0.1, 600.0},
           "wheels at rest for this long without an accepted standstill mean that the rover slides [s]");
  v.number("retry_after_slide_s", retry_after_slide_s, {0.0, 3600.0},
           "no stop for this long after one that ended in sliding, or never reached standstill [s]");
  v.number("estimate_timeout_s", estimate_timeout_s, {0.1, 3600.0},
           "without an estimate for this long, commands pass and no stop begins [s]");
  v.number("command_timeout_s", command_timeout_s, {0.1, 3600.0},
           "diagnostics warn when cmd_vel_in has been silent for this long [s]");
}

StopMode StopParams::stopMode() const {
  return mode == "active" ? StopMode::kActive : mode == "advise" ? StopMode::kAdvise : StopMode::kOff;
}

}  // namespace slipnav
