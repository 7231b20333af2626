#pragma once
/// What the forecast is made from, and forecasts, as messages.

#include <slipnav/ErrorForecast.h>
#include <slipnav/ForecastInput.h>
#include <slipnav/SlipForecast.h>

#include <string>

#include "config/frames.h"
#include "core/forecast/forecast_method.h"

namespace slipnav {

/// The parts of an estimate and its covariance that a forecast uses. Lossless.
void fill(const Estimate& estimate, const ErrorCovariance& P, ForecastInput& message);
/// The parts of an estimate that were sent; the others keep their defaults.
Estimate estimateOf(const ForecastInput& message);
ErrorCovariance covarianceOf(const ForecastInput& message);

/// @param model name of the slip model; @param computation_ms time taken by fit and forecast
void fill(const Forecast& forecast, const std::string& model, double computation_ms, const FrameNames& frames,
          SlipForecast& message);

void fill(const ErrorOutlook& error, const FrameNames& frames, ErrorForecast& message);

}  // namespace slipnav
