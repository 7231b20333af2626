#pragma once
/// Two estimates of the same drive.

#include <cstddef>
#include <string>

#include "evaluation/estimate.h"

namespace slipnav {

/// How far two tracks are apart at common stamps.
struct TrackComparison {
  std::size_t common = 0;  ///< epochs that both have
  double largest_m = 0.0;  ///< largest distance between them there
};

TrackComparison compareTracks(const EstimateTrack& a, const EstimateTrack& b);

/// One line of text, with a newline. @param name of the run compared with the offline one
std::string comparisonText(const std::string& name, const EstimateTrack& run, const EstimateTrack& offline);

}  // namespace slipnav
