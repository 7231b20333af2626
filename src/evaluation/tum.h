#pragma once
/// Trajectories in the format of the TUM RGB-D benchmark: `stamp tx ty tz qx qy qz qw`, one pose a line.
///
/// Stamps are written with nine decimals straight from the integer, so that they round-trip bit for bit.

#include <string>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/truth_track.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// One line: pose of base_link in the map frame.
struct TumPose {
  Nanoseconds stamp = 0;
  Vector3 position_enu_m = Vector3::Zero();
  Quaternion q_flu_to_enu = Quaternion::Identity();
};

std::vector<TumPose> tumPoses(const EstimateTrack& estimates);
/// The identity is written where truth has no attitude.
std::vector<TumPose> tumPoses(const TruthTrack& truth);

/// Writes the file atomically. Throws std::runtime_error naming the path.
void writeTum(const std::string& path, const std::vector<TumPose>& poses);

/// Reads a file; skips blank lines and lines that begin with `#`. Throws std::runtime_error naming file and line.
std::vector<TumPose> readTum(const std::string& path);

}  // namespace slipnav
