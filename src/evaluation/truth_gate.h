#pragma once
/// Rejects implausible truth.

#include <set>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/truth_track.h"

namespace slipnav {

/// Without rows far from the median of the five around them: more than a meter, three times their usual σ and
/// eight times the usual deviation (median absolute deviation). A satellite receiver that falls back to a single
/// position for a moment would lengthen the distance, and count as an error of the estimate.
TruthTrack withoutJumps(const TruthTrack& truth);

/// Which fixes an evaluation would keep as truth: of equal stamps one or none.
std::set<Nanoseconds> stampsWithoutJumps(const std::vector<GnssFix>& fixes);

/// Throws std::invalid_argument with one line if truth ends before the estimate begins, or begins after its end.
void requireTimeInCommon(const TruthTrack& truth, const EstimateTrack& estimates);

}  // namespace slipnav
