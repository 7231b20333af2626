#include "ros/messages/wheel_input.h"

#include <cmath>

#include "ros/messages/conversions.h"

namespace slipnav {

WheelInput::WheelInput(const Config& config)
    : geometry_(config.wheelGeometry()),
      decoder_(config.wheels, config.wheel_monitor.max_speed_mps),
      source_(config.wheel.source),
      odometry_scale_(config.wheel.odometry_scale),
      stamp_delay_(fromSeconds(config.wheel.stamp_delay_s)),
      joint_topic_(config.topics.joint_states),
      odometry_topic_(config.topics.wheel_odometry) {}

WheelMotion WheelInput::atEndOfInterval(WheelMotion wheels) const {
  wheels.stamp -= stamp_delay_;
  return wheels;
}

/// A sample without a time is useless, and would otherwise be dropped without a visible cause.
bool WheelInput::isStamped(const std_msgs::Header& header, const std::string& topic) {
  if (header.stamp.isZero()) {
    problem_ = noStamps(topic);
  }
  return problem_.empty();
}

std::optional<WheelMotion> WheelInput::take(const sensor_msgs::JointState& message) {
  problem_.clear();
  remark_.clear();
  if (!wantsJointStates() || !isStamped(message.header, joint_topic_)) {
    return std::nullopt;
  }
  const std::optional<WheelSample> sample =
      decoder_.decode({toNanoseconds(message.header.stamp), message.name, message.position, message.velocity});
  if (!decoder_.problem().empty()) {
    problem_ = joint_topic_ + " " + decoder_.problem();
  }
  if (!decoder_.remark().empty()) {
    remark_ = joint_topic_ + " " + decoder_.remark();
  }
  if (!sample) {
    return std::nullopt;
  }
  joints_heard_ = true;
  return atEndOfInterval(toWheelMotion(geometry_, *sample));
}

std::optional<WheelMotion> WheelInput::take(const nav_msgs::Odometry& message) {
  problem_.clear();
  remark_.clear();
  if (!wantsOdometry() || joints_heard_ || !isStamped(message.header, odometry_topic_)) {
    return std::nullopt;
  }
  const double forward_mps = message.twist.twist.linear.x;
  if (!std::isfinite(forward_mps)) {
    problem_ = odometry_topic_ + " has a forward speed that is not a finite number";
    return std::nullopt;
  }
  return atEndOfInterval(
      toWheelMotion(SpeedSample{toNanoseconds(message.header.stamp), odometry_scale_ * forward_mps}));
}

}  // namespace slipnav
