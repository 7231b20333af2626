#pragma once
/// The drawing of a drive as rviz messages. See doc/visualization.md for their appearance.

#include <nav_msgs/Path.h>
#include <slipnav/ErrorForecast.h>
#include <visualization_msgs/MarkerArray.h>

#include <set>
#include <string>
#include <utility>

#include "overlay/drive_view.h"

namespace slipnav {

/// What is drawn besides the track of the drive.
struct OverlayMessages {
  ErrorForecast::ConstPtr error_forecast;  ///< the newest one; null if there is none
  bool stale = false;                      ///< estimates have stopped: only drawings of the present are removed
};

/// Distance, error against the truth if there is one, and 3σ, in one line.
std::string figuresOf(const DriveView& picture);

/// @param frame_id the map frame
nav_msgs::Path toPath(const DisplayTrack& track, const std::string& frame_id);

/// Everything except the three paths. Empty before the drive begins.
class OverlayMarkers {
 public:
  OverlayMarkers(const OverlayParams& params, std::string frame_id) : params_(params), frame_id_(std::move(frame_id)) {}

  /// Current markers, and deletions of those that no longer exist.
  visualization_msgs::MarkerArray make(const DriveView& picture, const OverlayMessages& messages);

 private:
  using Key = std::pair<std::string, int>;

  OverlayParams params_;
  std::string frame_id_;
  std::set<Key> shown_;
};

}  // namespace slipnav
