#pragma once
/// What the stop supervisor tells the rover, on every topic a rover may listen to, and who listens.

#include <geometry_msgs/Twist.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

#include <string>

#include "config/topics.h"
#include "core/stopping/stop_reach.h"
#include "core/stopping/velocity_command.h"
#include "ros/runtime/shared_publisher.h"

namespace slipnav {

/// Publishers of cmd_vel, stop_cmd and e_stop.
class StopOutputs {
 public:
  /// stop_cmd and e_stop.
  void advertise(ros::NodeHandle& node, const TopicNames& topics);
  /// cmd_vel. Nothing is published on it before.
  void advertiseCommands(ros::NodeHandle& node, const TopicNames& topics);
  bool hasCommands() const { return !command_topic_.empty(); }

  void command(const VelocityCommand& command) const;
  /// @param seconds until the stop
  void countDown(double seconds) const;
  void lock(bool locked) const;

  /// Not counting recorders, as far as the master knows who listens.
  StopListeners listeners() const;
  /// The same by name: "cmd_vel is heard by /base; e_stop by nobody".
  std::string listenersInWords() const;
  bool hasListenersToCommands() const { return command_publisher_.hasSubscribers(); }

 private:
  std::string command_topic_;
  std::string lock_topic_;
  SharedPublisher<geometry_msgs::Twist> command_publisher_;
  SharedPublisher<std_msgs::Float64> countdown_publisher_;
  SharedPublisher<std_msgs::Bool> lock_publisher_;
};

}  // namespace slipnav
