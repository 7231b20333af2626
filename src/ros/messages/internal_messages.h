#pragma once
/// Between the core's own structs and the messages that Ins, Filter and Initializer exchange. Lossless.

#include <slipnav/FilterCorrection.h>
#include <slipnav/ForecastInput.h>
#include <slipnav/InertialState.h>
#include <slipnav/InsInterval.h>
#include <slipnav/InsSteps.h>
#include <slipnav/StartState.h>

#include "core/ordering/continuous_time.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ins/ins_engine.h"

namespace slipnav {

InertialState toMessage(const NavigationState& state);
NavigationState fromMessage(const InertialState& message);

InsInterval toMessage(const InsStep& step);
/// @param epoch of the batch that the interval came in
InsStep fromMessage(const InsInterval& message, std::uint32_t epoch);

/// How the clock was set back; the rest of the message is unchanged.
void fill(const ContinuousTime& time, InsSteps& message);
ContinuousTime timeOf(const InsSteps& message);

/// Fills everything but the counts; `known` is set.
void fill(const InitialState& initial, StartState& message);
InitialState fromMessage(const StartState& message);

/// The parts of an estimate and its covariance that a Forecaster uses.
void fill(const Estimate& estimate, const ErrorCovariance& P, ForecastInput& message);
/// The parts of an estimate that were sent; the others keep their defaults.
Estimate estimateOf(const ForecastInput& message);
ErrorCovariance covarianceOf(const ForecastInput& message);

/// Fills everything but the start and the look-ahead.
void fill(const Correction& correction, FilterCorrection& message);
/// For a message that corrects.
Correction fromMessage(const FilterCorrection& message);

}  // namespace slipnav
