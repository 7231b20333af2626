#pragma once
/// Faults of sensors and their messages, injected into a recording.

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/NavSatFix.h>

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "config/config.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// One message of a recording.
struct RecordedMessage {
  ros::Time time;  ///< when it was recorded
  std::string topic;
  std::variant<sensor_msgs::Imu, sensor_msgs::JointState, sensor_msgs::NavSatFix, nav_msgs::Odometry> content;
};

using Recording = std::vector<RecordedMessage>;

/// The messages of a bag that have one of those types. Throws std::runtime_error if it cannot be read.
Recording readRecording(const std::string& path);
void writeRecording(const std::string& path, const Recording& recording);

/// When faults begin; each lasts as long as is typical for it.
struct FaultTimes {
  ros::Time drive;           ///< in the middle of the drive
  ros::Time initialization;  ///< during the search for a start
};

/// One fault: its name, and the change it makes to a recording.
struct Fault {
  std::string name;
  std::function<void(Recording&, const FaultTimes&)> inject;
  bool at_initialization = false;
};

/// All of them. @param config names topics and ranges
std::vector<Fault> allFaults(const Config& config);

}  // namespace slipnav
