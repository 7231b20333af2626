#pragma once
/// What forecasts promised, against what came.

#include <vector>

#include "evaluation/report.h"

namespace slipnav {

/// Compares every forecast, at the end of its horizon, with the horizontal error that has grown by then since the last
/// standstill (before the first one: since the first estimate). Forecasts whose horizon a stop, a gap of truth or the
/// end of the drive cuts short count for nothing. Fills the `forecast_…` figures of `metrics`; without a forecast that
/// can be judged they stay empty.
/// @param forecasts in order of stamp, the rows of one forecast together
void judgeForecasts(const std::vector<ForecastRow>& forecasts, const EstimateTrack& estimates, const TruthTrack& truth,
                    Metrics& metrics);

}  // namespace slipnav
