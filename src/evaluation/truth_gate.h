#pragma once
/// Truth that can be believed.

#include <set>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/truth_track.h"

namespace slipnav {

/// Without rows that lie far from the median of the five about them: more than a meter, three times their usual σ and
/// eight times the usual deviation (median absolute deviation). A satellite receiver that falls back to a single
/// position for a moment would lengthen the way, and count as error of the estimate.
TruthTrack withoutJumps(const TruthTrack& truth);

/// Which fixes are in the truth that an evaluation would make of all of them: of equal stamps one or none.
std::set<Nanoseconds> stampsWithoutJumps(const std::vector<GnssFix>& fixes);

/// Throws std::invalid_argument of one line when truth ends before the estimate begins, or begins after its end.
void requireTimeInCommon(const TruthTrack& truth, const EstimateTrack& estimates);

}  // namespace slipnav
