#pragma once
/// The track of somebody else on the same drive: visual odometry, another filter, anything that gives poses.

#include <string>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/metrics.h"
#include "evaluation/truth_track.h"
#include "evaluation/tum.h"

namespace slipnav {

/// Beside the estimate: the same figures over the same part of the drive. Without covariance, so nothing is said of its
/// consistency.
struct OtherTrack {
  std::string name;
  EstimateTrack estimates;  ///< in the map frame
  Metrics metrics;
};

/// Moves the poses into the map frame and judges them by `truth`. Where they begin, and how far they are turned about
/// up, is nobody's error: they are put where the reference is at the first epoch in common, and turned by the shape of
/// its first 30 m. The reference is truth, or where there is none the estimate.
/// @param name stands in the table
/// @param estimates of the run, whose time they are cut to and whose stops they share
/// Throws std::invalid_argument that names `name` when they have nothing in common with the drive.
OtherTrack besideTheEstimate(const std::string& name, const std::vector<TumPose>& poses, const EstimateTrack& estimates,
                             const TruthTrack& truth);

}  // namespace slipnav
