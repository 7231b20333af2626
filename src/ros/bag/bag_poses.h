#pragma once
/// Poses from another system in a recording.

#include <string>
#include <vector>

#include "evaluation/tum.h"

namespace slipnav {

/// All poses of a topic by their header's stamp: nav_msgs/Odometry, geometry_msgs/PoseStamped,
/// geometry_msgs/PoseWithCovarianceStamped or geometry_msgs/TransformStamped. Poses that are not finite are skipped.
/// @param paths the parts of one recording
/// Throws std::invalid_argument that names the topic if there is none, or none with poses.
std::vector<TumPose> readPoses(const std::vector<std::string>& paths, const std::string& topic);

}  // namespace slipnav
