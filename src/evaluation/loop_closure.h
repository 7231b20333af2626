#pragma once
/// A drive that is known to end where it began, judged by that alone.

#include "evaluation/estimate.h"
#include "evaluation/metrics.h"

namespace slipnav {

/// Fills the figures of the closure, of a drive without truth the distance by its own estimate too, and says the
/// verdict anew. What the start is off by is the end off by too: 3σ are those of what the covariance has grown by.
/// @param uses_stops as in MetricsInput
/// Throws std::invalid_argument when the estimate is empty.
void addLoopClosure(const EstimateTrack& estimates, bool uses_stops, Metrics& metrics);

}  // namespace slipnav
