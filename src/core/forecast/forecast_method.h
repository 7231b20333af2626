#pragma once
/// A method of forecasting, of which `forecast.schedule` selects one: from the filter's estimates to the slip and the
/// position error ahead, and the time at which the rover is to stop.

#include <memory>
#include <optional>
#include <string>

#include "core/forecast/covariance_forecast.h"
#include "core/forecast/error_outlook.h"
#include "core/forecast/forecast_params.h"
#include "core/forecast/gaussian_process_slip_model.h"
#include "core/forecast/slip_correlation.h"

namespace slipnav {

/// One forecast with everything it was made from.
struct Forecast {
  SlipFit fit;
  SlipPrediction slip;          ///< times ahead of the stamp
  GaussMarkovSlip correlation;  ///< of the predicted slip
  GroundOutlook outlook;
  ErrorOutlook error;
};

/// Receives every estimate, and makes a forecast when one is due.
class ForecastMethod {
 public:
  virtual ~ForecastMethod() = default;

  /// Takes each estimate of the filter in order, with its covariance. An estimate that is not newer than the one before
  /// restarts everything. @return a forecast if one is due
  virtual std::optional<Forecast> push(const Estimate& estimate, const ErrorCovariance& P) = 0;

  /// Applies a new threshold, window, horizon and measurement noise from the next estimate on. Schedule, slip model,
  /// step and bound must be those of the constructor.
  virtual void retune(const FilterSetup& setup, const ForecastParams& params) = 0;

  /// Forgets everything.
  virtual void reset() = 0;

  /// Why the last forecast that was due could not be made; empty if it could.
  virtual const std::string& problem() const = 0;
};

/// The method that `forecast.schedule` names. Throws std::invalid_argument naming a parameter that is out of range.
std::unique_ptr<ForecastMethod> makeForecastMethod(const Planet& planet, const FilterSetup& setup,
                                                   const ForecastParams& params);

/// What every method asks of an estimate first: it is that of a wheel interval, and finite, or else `problem` says so.
bool isUsable(const Estimate& estimate, const ErrorCovariance& P, std::string& problem);

}  // namespace slipnav
