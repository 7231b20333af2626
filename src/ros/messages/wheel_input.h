#pragma once
/// The wheel motion from whichever message the robot publishes.

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/JointState.h>

#include <optional>
#include <string>

#include "config/config.h"
#include "core/sensors/wheel_decoder.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// Of two sources one is used (see wheel.source). Every listener decides alike: `auto` uses wheel_odometry only as
/// long as no usable joint_states has arrived.
class WheelInput {
 public:
  explicit WheelInput(const Config& config);

  /// Nothing if the message cannot be used; problem() says why if something is wrong with it.
  std::optional<WheelMotion> take(const sensor_msgs::JointState& message);
  /// Forward speed only: the heading rate of such odometry may come from anywhere.
  std::optional<WheelMotion> take(const nav_msgs::Odometry& message);

  /// What was wrong with the last message in one line that names its topic, otherwise "".
  const std::string& problem() const { return problem_; }

  /// The topic that samples are taken from.
  const std::string& topic() const { return joints_heard_ ? joint_topic_ : odometry_topic_; }

  /// A remark about the messages, reported once, with the first one that shows it; otherwise "".
  const std::string& remark() const { return remark_; }

  bool wantsJointStates() const { return source_ != "wheel_odometry"; }
  bool wantsOdometry() const { return source_ != "joint_states"; }

 private:
  bool isStamped(const std_msgs::Header& header, const std::string& topic);
  WheelMotion atEndOfInterval(WheelMotion wheels) const;

  WheelGeometry geometry_;
  WheelDecoder decoder_;
  std::string source_;
  double odometry_scale_;
  Nanoseconds stamp_delay_;
  std::string joint_topic_;
  std::string odometry_topic_;
  bool joints_heard_ = false;
  std::string problem_;
  std::string remark_;
};

}  // namespace slipnav
