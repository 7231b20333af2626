#include "ros/messages/imu_input.h"

#include <algorithm>

#include "ros/messages/conversions.h"

namespace slipnav {
namespace {

constexpr char kAbsent[] = ": covariance[0] is -1; choose a topic of the driver that has it";

/// Frames are written with and without a leading slash.
std::string bare(const std::string& frame_id) {
  return frame_id.substr(std::min(frame_id.find_first_not_of('/'), frame_id.size()));
}

/// By the definition of sensor_msgs/Imu: there is no such measurement.
template <class Covariance>
bool saysAbsent(const Covariance& covariance) {
  return covariance[0] == -1.0;
}

}  // namespace

ImuInput::ImuInput(const Config& config)
    : mount_(config.imu.mount), topic_(config.topics.imu), configured_frame_(bare(config.frames.imu)) {}

bool ImuInput::isOfTheSensor(const std::string& frame_id) {
  const std::string frame = bare(frame_id);
  if (!frame_ || (frame == configured_frame_ && frame != *frame_)) {
    frame_ = frame;
  }
  if (frame == *frame_) {
    return true;
  }
  problem_ = topic_ + " comes from two sensors: frame_id '" + *frame_ + "' is used, '" + frame +
             "' is ignored; give each driver its own topic, or set frames.imu";
  return false;
}

std::optional<ImuSample> ImuInput::take(const sensor_msgs::Imu& message) {
  problem_.clear();
  if (!isOfTheSensor(message.header.frame_id)) {
    return std::nullopt;
  }
  if (saysAbsent(message.linear_acceleration_covariance)) {
    problem_ = topic_ + " says that it has no linear acceleration" + kAbsent;
  } else if (saysAbsent(message.angular_velocity_covariance)) {
    problem_ = topic_ + " says that it has no angular velocity" + kAbsent;
  } else if (message.header.stamp.isZero()) {
    problem_ = noStamps(topic_);
  }
  return problem_.empty() ? std::optional<ImuSample>(toImuSample(message, mount_)) : std::nullopt;
}

}  // namespace slipnav
