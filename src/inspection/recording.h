#pragma once
/// A raw recording: no axes rotated, no units converted, nothing dropped.

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// When a message was stamped and when it was recorded.
struct MessageTime {
  Nanoseconds stamp = 0;
  Nanoseconds received = 0;
};

/// In the sensor's own axes; [m/s²] and [rad/s] if the driver is correct.
struct RawImuSample {
  MessageTime time;
  Vector3 specific_force = Vector3::Zero();
  Vector3 angular_rate = Vector3::Zero();
};

/// One sensor: a topic and a frame_id.
struct ImuRecord {
  std::string topic;
  std::string frame;
  std::vector<RawImuSample> samples;
  std::size_t without_force = 0;  ///< messages that say so: linear_acceleration_covariance[0] = -1
  std::size_t without_rate = 0;   ///< likewise angular_velocity_covariance[0] = -1
};

/// Values in the order of the record's names; empty if the message has none.
struct RawJointSample {
  MessageTime time;
  std::vector<double> position_rad;
  std::vector<double> velocity_radps;
};

/// The messages of one topic that have the same joints.
struct JointRecord {
  std::string topic;
  std::vector<std::string> names;
  std::vector<RawJointSample> samples;
};

/// Pose and motion of an odometry; a pose has no motion.
struct RawPoseSample {
  MessageTime time;
  Vector3 position_m = Vector3::Zero();
  std::optional<Quaternion> q_to_parent;  ///< attitude, if known
  double forward_mps = 0.0;
  double yaw_rate_radps = 0.0;  ///< positive left
};

/// A topic of odometry or poses.
struct PoseRecord {
  std::string topic;
  std::string frame;
  bool has_motion = false;  ///< nav_msgs/Odometry
  std::vector<RawPoseSample> samples;
};

/// A satellite position, whatever its status.
struct RawFixSample {
  MessageTime time;
  bool has_fix = false;     ///< by its status
  bool is_nowhere = false;  ///< latitude 0, longitude 0
  bool is_usable = false;   ///< finite, in range, with a fix
  bool has_covariance = false;
  GnssFix fix;
};

/// Satellite positions of one topic and one frame.
struct FixRecord {
  std::string topic;
  std::string frame;
  std::vector<RawFixSample> samples;
  std::map<std::string, std::size_t> left_out;  ///< rows of a file without a position, by what they are
};

/// A pose in /tf or /tf_static.
struct TransformRecord {
  std::string parent;
  std::string child;
  bool is_static = false;  ///< latched in /tf_static
  Vector3 position_m = Vector3::Zero();
  Quaternion q_child_to_parent = Quaternion::Identity();
};

/// Every topic, including those not used here.
struct TopicRecord {
  std::string topic;
  std::string type;
  std::size_t messages = 0;
  std::size_t publishers = 0;
};

/// All parts of one drive together, in recording order.
struct Recording {
  Nanoseconds begin = 0;
  Nanoseconds end = 0;
  std::vector<TopicRecord> topics;
  std::vector<ImuRecord> imus;
  std::vector<JointRecord> joints;
  std::vector<PoseRecord> poses;
  std::vector<FixRecord> fixes;
  std::vector<TransformRecord> transforms;
  std::vector<std::string> damage;  ///< messages that could not be read: what was wrong
};

}  // namespace slipnav
