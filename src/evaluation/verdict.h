#pragma once
/// One line that says what a run is worth.

#include <string>

#include "evaluation/metrics.h"

namespace slipnav {

/// "consistent", "cautious" (errors far below what the covariance says), "over-confident: ..." (far above), or "not
/// judged: no truth"; followed by "worse than wheels and gyro alone: ..." and "stops seen but not used: ..." where that
/// is so.
/// @param uses_stops whether zero-velocity updates are part of the run
std::string verdictOf(const Metrics& metrics, bool uses_stops);

}  // namespace slipnav
