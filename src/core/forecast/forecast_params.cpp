#include "core/forecast/forecast_params.h"

namespace slipnav {

void ForecastParams::visit(ParameterVisitor& v) {
  v.number("threshold_m", threshold_m, {1e-3, 1e4}, "bound on the horizontal position error at which to stop [m]");
  v.choice("schedule", schedule, {"sliding", "paper"},
           "sliding: every interval_s on the newest window; paper: the paper's method, one forecast per window whose "
           "countdown is kept, see config/paper.yaml");
  v.choice("bound", bound, {"growth", "absolute"},
           "growth: of the error since the last stop; absolute: total error, which no stop reduces");
  v.number("sigmas", sigmas, {0.5, 10.0}, "the bound in standard deviations");
  v.number("window_s", window_s, {1.0, 600.0}, "how much free driving the slip model learns from: this long [s]");
  v.number("window_m", window_m, {0.1, 1e4},
           "and at least this far; with schedule: paper, whichever is reached first [m]");
  v.number("interval_s", interval_s, {0.1, 60.0}, "time between forecasts, in stamps [s]");
  v.number("horizon_s", horizon_s, {1.0, 600.0}, "how far to forecast [s]");
  v.number("step_s", step_s, {0.02, 5.0}, "between simulated wheel measurements [s]");
  v.number("wheel_interval_s", wheel_interval_s, {0.001, 1.0}, "between real ones [s]");
  v.number("max_age_s", max_age_s, {1.0, 3600.0},
           "slip from before this much standstill is dropped from the window [s]");
  v.number("speed_window_s", speed_window_s, {0.1, 600.0},
           "the future speed is the mean over this much driving, without starts and stops [s]");
  slip.visit(v);
  v.group("sigma_points", sigma_points, "from slip to wheel speed");
}

}  // namespace slipnav
