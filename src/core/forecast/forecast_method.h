#pragma once
/// The forecaster selected by `forecast.schedule`, behind a common interface.

#include <optional>
#include <string>
#include <variant>

#include "core/forecast/forecaster.h"
#include "core/forecast/paper_forecaster.h"

namespace slipnav {

/// Forecaster or PaperForecaster.
class ForecastMethod {
 public:
  /// Throws std::invalid_argument naming a parameter that is out of range.
  ForecastMethod(const Planet& planet, const FilterSetup& setup, const ForecastParams& params);

  /// Takes each estimate of the filter in order, with its covariance. @return a forecast if one is due
  std::optional<Forecast> push(const Estimate& estimate, const ErrorCovariance& P);

  /// Applies other parameters from the next estimate on. Schedule, slip model and bound must be those of the
  /// constructor.
  void retune(const FilterSetup& setup, const ForecastParams& params);

  /// Forgets everything.
  void reset();

  /// Why the last forecast that was due could not be made; empty if it could.
  const std::string& problem() const;

 private:
  std::variant<Forecaster, PaperForecaster> method_;
};

}  // namespace slipnav
