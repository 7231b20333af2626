#pragma once
/// Publishes what the simulated rover measures, and its clock.

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "slipnav/ros/simulated_sensors.h"

namespace slipnav {

/// The publishers of the nodelet Simulator.
class SensorPublisher {
 public:
  SensorPublisher(ros::NodeHandle& node, const Config& config);

  /// One interval: the clock at its end, then the samples in order of their stamps.
  void publish(const sim::Measurements& measurements, const sim::TruthState& truth);

 private:
  SimulatedSensors sensors_;
  ros::Publisher clock_;
  ros::Publisher imu_;
  ros::Publisher joints_;
  ros::Publisher gps_;
  ros::Publisher truth_fix_;
  ros::Publisher truth_odometry_;
};

}  // namespace slipnav
