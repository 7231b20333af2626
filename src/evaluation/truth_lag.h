#pragma once
/// Whether the clock of a truth is that of the drive: receivers in GPS time are 18 s ahead.

#include <optional>
#include <string>

#include "evaluation/planar_dead_reckoning.h"
#include "evaluation/truth_track.h"

namespace slipnav {

/// A truth that fits the drive only at another time.
struct TruthLag {
  double late_s = 0.0;   ///< its stamps less those of the drive, for the same place
  double rms_m = 0.0;    ///< horizontal distance from the drive as it is stamped
  double apart_m = 0.0;  ///< and that without the lag
};

/// The drive, shifted, rotated and scaled in the plane, is fitted to the truth for each lag of up to a minute either
/// way. A drive of constant speed on a straight line fits any lag, and nothing is claimed.
/// @return nothing if no lag explains half of the distance between them
std::optional<TruthLag> truthLag(const PlanarTrack& drive, const TruthTrack& truth);

/// "18.0 s late (18 s: GPS time instead of UTC?): ...", for messages that begin with the name of the truth.
std::string describe(const TruthLag& lag);

}  // namespace slipnav
