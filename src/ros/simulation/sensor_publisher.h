#pragma once
/// Publishes the simulated rover's measurements, and its clock.

#include <ros/node_handle.h>
#include <rosgraph_msgs/Clock.h>

#include <optional>

#include "ros/messages/simulated_sensors.h"
#include "ros/runtime/shared_publisher.h"

namespace slipnav {

/// The publishers of the nodelets Simulator and SimulatedRover.
class SensorPublisher {
 public:
  /// Whether time is simulated.
  enum class Clock { kSimulated, kNone };

  SensorPublisher(ros::NodeHandle& node, const Config& config, Clock clock = Clock::kSimulated);

  /// One interval: the clock at its end, unless it was just published, then the samples in order of their stamps.
  void publish(const sim::Measurements& measurements, const sim::TruthState& truth);

  /// Each sensor used by the navigation has a subscriber.
  bool areHeard() const { return imu_.hasSubscribers() && joints_.hasSubscribers() && gps_.hasSubscribers(); }

 private:
  void publishClock(Nanoseconds stamp);

  SimulatedSensors sensors_;
  ros::SteadyTime told_clock_;
  std::optional<SharedPublisher<rosgraph_msgs::Clock>> clock_;
  SharedPublisher<sensor_msgs::Imu> imu_;
  SharedPublisher<sensor_msgs::JointState> joints_;
  SharedPublisher<sensor_msgs::NavSatFix> gps_;
  SharedPublisher<sensor_msgs::NavSatFix> truth_fix_;
  SharedPublisher<nav_msgs::Odometry> truth_odometry_;
};

}  // namespace slipnav
