#pragma once
/// Reports the progress of the search for a start, and its result: `initialization`, and the frame `map`.

#include <ros/node_handle.h>
#include <slipnav/Initialization.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <string>

#include "config/frames.h"
#include "ros/runtime/shared_publisher.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// The messages of the Initializer nodelet. Both calls return the line for its log.
class StartReporter {
 public:
  StartReporter(ros::NodeHandle& node, const FrameNames& frames);

  /// "" if that was reported before. @param stamp of the newest sample
  std::string search(const std::string& progress, Nanoseconds stamp);
  /// @param how the start was found
  std::string end(const InitialState& initial, const std::string& how);

  /// What was reported last.
  const std::string& progress() const { return progress_; }

 private:
  void sendMapToOdom(const ros::Time& stamp);

  FrameNames frames_;
  std::string progress_;
  SharedPublisher<Initialization> publisher_;
  tf2_ros::StaticTransformBroadcaster tf_;
};

}  // namespace slipnav
