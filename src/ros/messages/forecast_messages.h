#pragma once
/// Forecasts as messages.

#include <slipnav/ErrorForecast.h>
#include <slipnav/SlipForecast.h>

#include <string>

#include "config/frames.h"
#include "core/forecast/forecaster.h"

namespace slipnav {

/// @param model name of the slip model; @param computation_ms time taken by fit and forecast
void fill(const Forecast& forecast, const std::string& model, double computation_ms, const FrameNames& frames,
          SlipForecast& message);

void fill(const ErrorOutlook& error, const FrameNames& frames, ErrorForecast& message);

}  // namespace slipnav
