#pragma once
/// Says how the search for a start goes, and what it has found: `initialization`, and the frame `map`.

#include <ros/node_handle.h>
#include <slipnav/Initialization.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <string>

#include "config/frames.h"
#include "ros/runtime/shared_publisher.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// The words of the nodelet Initializer. Both calls return the line for its log.
class StartReporter {
 public:
  StartReporter(ros::NodeHandle& node, const FrameNames& frames);

  /// "" when that was said before. @param stamp of the newest sample
  std::string search(const std::string& progress, Nanoseconds stamp);
  /// @param how the start was found
  std::string end(const InitialState& initial, const std::string& how);

  /// What was said last.
  const std::string& progress() const { return progress_; }

 private:
  void sendMapToOdom(const ros::Time& stamp);

  FrameNames frames_;
  std::string progress_;
  SharedPublisher<Initialization> publisher_;
  tf2_ros::StaticTransformBroadcaster tf_;
};

}  // namespace slipnav
