#pragma once
/// The picture of a drive as messages for rviz. See doc/visualisation.md for what each of them looks like.

#include <nav_msgs/Path.h>
#include <slipnav/ErrorForecast.h>
#include <visualization_msgs/MarkerArray.h>

#include <set>
#include <string>
#include <utility>

#include "overlay/drive_picture.h"

namespace slipnav {

/// What is drawn beside the picture of the drive.
struct OverlayMessages {
  ErrorForecast::ConstPtr error_forecast;  ///< the newest one; null where there is none
  bool stale = false;                      ///< no estimates come any more: what is of now alone is left out
};

/// Distance, error against the truth where there is one, and 3σ, in one line.
std::string figuresOf(const DrivePicture& picture);

/// @param frame_id the map frame
nav_msgs::Path toPath(const DisplayTrack& track, const std::string& frame_id);

/// Everything but the three paths. Empty before the drive begins.
class OverlayMarkers {
 public:
  OverlayMarkers(const OverlayParams& params, std::string frame_id) : params_(params), frame_id_(std::move(frame_id)) {}

  /// What is there now, and deletions of what was there the last time and is no more.
  visualization_msgs::MarkerArray make(const DrivePicture& picture, const OverlayMessages& messages);

 private:
  using Key = std::pair<std::string, int>;

  OverlayParams params_;
  std::string frame_id_;
  std::set<Key> shown_;
};

}  // namespace slipnav
