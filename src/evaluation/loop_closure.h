#pragma once
/// A drive known to end where it began, judged by that alone.

#include "evaluation/estimate.h"
#include "evaluation/metrics.h"

namespace slipnav {

/// Fills in the closure figures, for a drive without truth also the distance by its own estimate, and updates the
/// verdict. The error at the start is part of the error at the end: 3σ covers the growth of the covariance.
/// @param uses_stops as in MetricsInput
/// Throws std::invalid_argument if the estimate is empty.
void addLoopClosure(const EstimateTrack& estimates, bool uses_stops, Metrics& metrics);

}  // namespace slipnav
