#pragma once
/// Distance driven and stops made.

#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/truth_track.h"

namespace slipnav {

/// Path length of noisy positions.
///
/// The speed at each epoch is the slope of a cubic fitted to the positions around it, taken along the straight line
/// fitted to the same positions, and the distance is its integral. A sum of chords would grow by the noise of every
/// sample, even at standstill. Where the straight line is slower than the standstill speed, nothing is added. Truth
/// too sparse for such a fit (motion capture at 1 Hz) is assumed to be exact: the length of the smooth curve through
/// it. Across gaps the distance is that of the straight line.
struct DistanceOptions {
  double half_window_s = 1.0;          ///< the fit uses the samples this near
  double standstill_speed_mps = 0.03;  ///< slower counts as standing
  bool horizontal = false;             ///< ignore height: for truth whose height wanders
};

/// Distance [m] along the samples of truth in [from, to].
double distanceDriven(const TruthTrack& truth, Nanoseconds from, Nanoseconds to, const DistanceOptions& options = {});

/// Standstill between two stamps.
struct Stop {
  Nanoseconds begin = 0;
  Nanoseconds end = 0;  ///< first epoch that moves again
};

/// Stops of a drive by the stationary flags of the estimate. Motion shorter than `min_duration_s` counts as
/// standstill and standstill shorter than that is ignored. Standing before the first and after the last motion is not
/// a stop.
std::vector<Stop> findStops(const EstimateTrack& estimates, double min_duration_s = 0.5);

}  // namespace slipnav
