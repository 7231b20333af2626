#pragma once
/// Another system's track of the same drive: visual odometry, another filter, anything that gives poses.

#include <string>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/metrics.h"
#include "evaluation/truth_track.h"
#include "evaluation/tum.h"

namespace slipnav {

/// Next to the estimate: the same figures over the same part of the drive. Without covariance, so without
/// consistency figures.
struct OtherTrack {
  std::string name;
  EstimateTrack estimates;  ///< in the map frame
  Metrics metrics;
};

/// Moves the poses into the map frame and judges them by `truth`. Their initial position and heading do not count
/// as errors: they are moved to the reference at the first epoch in common, and rotated by the shape of
/// its first 30 m. The reference is truth, or if there is none the estimate.
/// @param name for the table
/// @param estimates of the run, whose time they are cut to and whose stops they share
/// Throws std::invalid_argument that names `name` if they have nothing in common with the drive.
OtherTrack besideTheEstimate(const std::string& name, const std::vector<TumPose>& poses, const EstimateTrack& estimates,
                             const TruthTrack& truth);

}  // namespace slipnav
