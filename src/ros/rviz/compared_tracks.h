#pragma once
/// What rviz shows of other systems' tracks on the same drive.

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "evaluation/other_track.h"

namespace slipnav {

/// A line and a name at its end for each track. @param map_frame the frame of the tracks
visualization_msgs::MarkerArray comparedTracks(const std::vector<OtherTrack>& tracks, const std::string& map_frame);

}  // namespace slipnav
