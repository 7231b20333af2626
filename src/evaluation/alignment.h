#pragma once
/// Transforms truth in its own frame into the frame of the estimate. Truth moves, the estimate stays.

#include "config/truth_params.h"
#include "evaluation/estimate.h"
#include "evaluation/truth_track.h"

namespace slipnav {

/// Moves truth rigidly so that its pose equals that of the estimate at the first truth epoch that the estimate covers.
/// Throws std::invalid_argument if the two have no epoch in common or truth has no attitude there.
TruthTrack alignAtStart(const TruthTrack& truth, const EstimateTrack& estimates, StartAlignment alignment);

/// Angle about up [rad] that rotates the horizontal shape of truth into that of the estimate, by least squares,
/// over the first `distance_m` of the estimate (all of it if it is shorter). Offsets do not matter.
/// Throws std::invalid_argument if truth covers less than 1 m of motion there.
double headingOffset(const TruthTrack& truth, const EstimateTrack& estimates, double distance_m);

/// Rotates truth by headingOffset() about the start of the estimate. For judging a drive whose initial heading came
/// from fixes too poor to determine it. An offset in position stays and counts as error.
TruthTrack alignHeading(const TruthTrack& truth, const EstimateTrack& estimates, double distance_m = 30.0);

/// Positions of the body origin from positions of a point fixed to the body, such as an antenna, at
/// `lever_flu_m` from it. Uses the attitude of the estimate; samples that the estimate does not cover are dropped.
TruthTrack removeLeverArm(const TruthTrack& truth, const EstimateTrack& estimates, const Vector3& lever_flu_m);

}  // namespace slipnav
