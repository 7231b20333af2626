#pragma once
/// How the stop supervisor decides.

#include <string>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// How far the supervisor may go: nothing, advice, or action.
enum class StopMode { kOff, kAdvise, kActive };

/// Block `stop`.
struct StopParams {
  std::string mode = "advise";
  double deceleration_mps2 = 0.5;
  double angular_deceleration_radps2 = 1.0;
  double max_stop_s = 6.0;
  double max_hold_s = 3.0;
  double converged_speed_std_mps = 0.002;
  int min_zero_updates = 8;
  double countdown_s = 10.0;
  double no_stop_due_s = 60.0;
  double min_drive_s = 5.0;
  double forecast_timeout_s = 5.0;
  double fallback_interval_s = 12.0;
  double slide_after_s = 1.5;
  double retry_after_slide_s = 30.0;
  double estimate_timeout_s = 2.0;
  double command_timeout_s = 1.0;
  void visit(ParameterVisitor& v);

  StopMode stopMode() const;
};

}  // namespace slipnav
