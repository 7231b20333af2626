#pragma once
/// Makes the forecasts of a run and records them.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "config/config.h"
#include "core/forecast/forecast_method.h"
#include "core/forecast/sigma_points.h"
#include "evaluation/report.h"

namespace slipnav {

/// Owns a forecaster and one row per forecast and whole second of its horizon.
class ForecastRecorder {
 public:
  using Sink = std::function<void(const ErrorOutlook&)>;

  explicit ForecastRecorder(const Config& config);

  /// The estimate restarts.
  void clear();
  /// Takes each estimate of the filter in order.
  void push(const Estimate& estimate, const ErrorCovariance& P, const Sink& sink);

  const std::vector<ForecastRow>& errorRows() const { return errors_; }
  const std::vector<SlipForecastRow>& slipRows() const { return slips_; }
  /// Computing time of each forecast [ms].
  const std::vector<double>& times_ms() const { return times_ms_; }

 private:
  void keep(const Forecast& forecast);

  std::unique_ptr<ForecastMethod> forecaster_;
  SigmaPoints sigma_points_;
  std::vector<ForecastRow> errors_;
  std::vector<SlipForecastRow> slips_;
  std::vector<double> times_ms_;
};

}  // namespace slipnav
