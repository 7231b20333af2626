#pragma once
/// The simulated rover's sensors as the messages of a real robot.

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/NavSatFix.h>

#include <optional>

#include "config/config.h"
#include "simulation/simulator.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav {

/// Fills messages from samples in core axes.
class SimulatedSensors {
 public:
  /// Throws std::invalid_argument if the configuration has a different number of wheels than the simulated rover.
  explicit SimulatedSensors(const Config& config);

  /// In the sensor's own axes, as configured in imu.mount.
  sensor_msgs::Imu imu(const ImuSample& sample) const;
  /// Positions and velocities, by the names and signs of the configured wheels.
  sensor_msgs::JointState joints(const WheelSample& sample, const sim::EncoderAngles& angle_rad) const;
  sensor_msgs::NavSatFix fix(const GnssFix& fix) const;
  /// The exact pose and motion of base_link, in a map frame about the pose of the first call.
  nav_msgs::Odometry truth(const sim::TruthState& truth);

 private:
  FrameNames frames_;
  std::vector<WheelParams> wheels_;
  ImuMount mount_;
  Planet planet_;
  std::optional<LocalFrame> map_;
};

}  // namespace slipnav
