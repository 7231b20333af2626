#pragma once
/// Between the stop supervisor and the messages around it: what it hears, and what it tells the rover on every topic
/// that a rover may listen to, and who listens.

#include <geometry_msgs/Twist.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <slipnav/StopStatus.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

#include <string>

#include "config/frames.h"
#include "config/topics.h"
#include "core/stopping/stop_reach.h"
#include "core/stopping/stop_supervisor.h"
#include "core/stopping/velocity_command.h"
#include "ros/runtime/shared_publisher.h"

namespace slipnav {

/// All six components unchanged: the supervisor works in any axes.
VelocityCommand toVelocityCommand(const geometry_msgs::Twist& message);
geometry_msgs::Twist toTwist(const VelocityCommand& command);

void fill(const SupervisorStatus& status, StopMode mode, const FrameNames& frames, StopStatus& message);

/// Derives observations from nav_state and slip: the same as observationOf() from the original estimate,
/// except for the rounding of a rotated covariance.
class RoverObserver {
 public:
  /// @param wheel_speed_at_rest_mps highest circumferential speed of a wheel at rest, see StationaryParams
  explicit RoverObserver(double wheel_speed_at_rest_mps) : wheel_speed_at_rest_mps_(wheel_speed_at_rest_mps) {}

  void setWheelSpeedAtRest(double speed_mps) { wheel_speed_at_rest_mps_ = speed_mps; }

  /// The slip of an estimate comes before its nav_state.
  void add(const Slip& message);
  RoverObservation observe(const NavState& message);

 private:
  double wheel_speed_at_rest_mps_;
  double forward_mps_ = 0.0;
  bool wheels_at_rest_ = false;
  bool has_wheels_ = false;  ///< a wheel interval has ended since the last nav_state
};

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
