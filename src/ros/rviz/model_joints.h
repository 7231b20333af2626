#pragma once
/// The turning wheels of the rover model in rviz, whatever message type the robot's wheels use.

#include <sensor_msgs/JointState.h>

#include <vector>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// The model (urdf/pathfinder.urdf) has the four wheels of pathfinderWheels(). They turn like the robot's wheels if
/// it has four, each known, and otherwise with its forward speed.
class ModelJoints {
 public:
  ModelJoints();

  void add(const WheelMotion& wheels);

  /// Angles up to the newest sample.
  sensor_msgs::JointState message() const;

 private:
  std::vector<WheelParams> model_;
  std::vector<double> angle_rad_;
  Nanoseconds stamp_ = 0;
};

}  // namespace slipnav
