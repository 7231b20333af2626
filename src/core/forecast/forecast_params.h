#pragma once
/// Configuration of forecasts.

#include <string>

#include "core/forecast/gaussian_process_slip_model.h"
#include "core/forecast/sigma_points.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `forecast`.
struct ForecastParams {
  /// The slip model that forecasts best, see doc/forecast.md; a model on its own defaults to the paper's.
  ForecastParams() {
    slip.model = "rbf_slow";
    slip.inference = "state_space";
  }

  double threshold_m = 3.0;
  std::string schedule = "sliding";
  std::string bound = "growth";
  double sigmas = 3.0;
  double window_s = 15.0;
  double window_m = 12.0;
  double interval_s = 1.0;
  double horizon_s = 60.0;
  double step_s = 0.5;
  double wheel_interval_s = 0.1;
  double max_age_s = 60.0;
  double speed_window_s = 3.0;
  SlipModelParameters slip;
  SigmaPointParameters sigma_points;

  void visit(ParameterVisitor& v);
};

}  // namespace slipnav
