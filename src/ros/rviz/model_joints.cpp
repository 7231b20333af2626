#include "ros/rviz/model_joints.h"

#include <cmath>

#include "ros/messages/conversions.h"

namespace slipnav {
namespace {

/// Longer intervals are gaps in which the wheels keep their angle.
constexpr double kLongestInterval_s = 1.0;

}  // namespace

ModelJoints::ModelJoints() : model_(pathfinderWheels()), angle_rad_(model_.size(), 0.0) {}

void ModelJoints::add(const WheelMotion& wheels) {
  const double dt_s = toSeconds(wheels.stamp - stamp_);
  stamp_ = wheels.stamp;
  if (dt_s <= 0.0 || dt_s > kLongestInterval_s) {
    return;
  }
  for (std::size_t i = 0; i < model_.size(); ++i) {
    const double speed_mps = wheels.count == model_.size() ? wheels.circumferential_mps[i] : wheels.motion.forward_mps;
    angle_rad_[i] = std::remainder(angle_rad_[i] + speed_mps * dt_s / model_[i].radius_m, 2.0 * kPi);
  }
}

sensor_msgs::JointState ModelJoints::message() const {
  sensor_msgs::JointState message;
  message.header.stamp = toRosTime(stamp_);
  for (std::size_t i = 0; i < model_.size(); ++i) {
    message.name.push_back(model_[i].name);
    message.position.push_back(angle_rad_[i]);
  }
  return message;
}

}  // namespace slipnav
