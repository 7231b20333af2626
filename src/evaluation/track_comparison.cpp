#include "evaluation/track_comparison.h"

#include <algorithm>

#include "core/base/text.h"

namespace slipnav {

TrackComparison compareTracks(const EstimateTrack& a, const EstimateTrack& b) {
  TrackComparison comparison;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].stamp == b[j].stamp) {
      const double distance_m = (a[i].position_enu_m - b[j].position_enu_m).norm();
      comparison.largest_m = std::max(comparison.largest_m, distance_m);
      ++comparison.common;
    }
    const bool advance_a = a[i].stamp <= b[j].stamp;
    j += b[j].stamp <= a[i].stamp ? 1 : 0;
    i += advance_a ? 1 : 0;
  }
  return comparison;
}

std::string comparisonText(const std::string& name, const EstimateTrack& run, const EstimateTrack& offline) {
  const TrackComparison comparison = compareTracks(run, offline);
  return name + ": " + std::to_string(run.size()) + " estimates, offline: " + std::to_string(offline.size()) +
         ", in common: " + std::to_string(comparison.common) +
         ", largest difference: " + formatNumber(comparison.largest_m) + " m\n";
}

}  // namespace slipnav
