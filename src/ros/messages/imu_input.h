#pragma once
/// Samples of one inertial sensor from its topic.

#include <sensor_msgs/Imu.h>

#include <optional>
#include <string>

#include "config/config.h"
#include "core/sensors/imu_mount.h"
#include "slipnav/core/base/sensors.h"

namespace slipnav {

/// Of several sensors on one topic the one with frames.imu is used, else the first. Every listener decides alike.
class ImuInput {
 public:
  explicit ImuInput(const Config& config);

  /// In body axes. Nothing if the message cannot be used; problem() says why.
  std::optional<ImuSample> take(const sensor_msgs::Imu& message);

  /// What was wrong with the last message in one line that names its topic, otherwise "".
  const std::string& problem() const { return problem_; }

 private:
  bool isOfTheSensor(const std::string& frame_id);

  ImuMount mount_;
  std::string topic_;
  std::string configured_frame_;
  std::optional<std::string> frame_;  ///< of the sensor in use
  std::string problem_;
};

}  // namespace slipnav
