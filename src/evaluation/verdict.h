#pragma once
/// One line that rates a run.

#include <string>

#include "evaluation/metrics.h"

namespace slipnav {

/// "consistent", "cautious" (errors far below the covariance), "over-confident: ..." (far above), or "not
/// judged: no truth"; followed by "worse than wheels and gyro alone: ..." and "stops seen but not used: ..." if
/// applicable.
/// @param uses_stops whether zero-velocity updates are part of the run
std::string verdictOf(const Metrics& metrics, bool uses_stops);

}  // namespace slipnav
