#include "ros/simulation/sensor_publisher.h"

#include <boost/make_shared.hpp>

#include "ros/messages/conversions.h"

namespace slipnav {
namespace {

/// In real time, like rosbag play: every node listens to the clock, and wakes up for it.
const ros::WallDuration kClockInterval(0.01);

template <class Message>
void send(const SharedPublisher<Message>& publisher, Message message) {
  publisher.publish(boost::make_shared<Message>(std::move(message)));
}

}  // namespace

SensorPublisher::SensorPublisher(ros::NodeHandle& node, const Config& config, Clock clock)
    : sensors_(config),
      imu_(SharedPublisher<sensor_msgs::Imu>(node, config.topics.imu)),
      joints_(SharedPublisher<sensor_msgs::JointState>(node, config.topics.joint_states)),
      gps_(SharedPublisher<sensor_msgs::NavSatFix>(node, config.topics.gps_fix)),
      truth_fix_(SharedPublisher<sensor_msgs::NavSatFix>(node, config.topics.truth_fix)),
      truth_odometry_(SharedPublisher<nav_msgs::Odometry>(node, config.topics.truth_odometry)) {
  if (clock == Clock::kSimulated) {
    clock_ = SharedPublisher<rosgraph_msgs::Clock>(node, "/clock");
  }
}

void SensorPublisher::publish(const sim::Measurements& measurements, const sim::TruthState& truth) {
  publishClock(truth.stamp);
  if (measurements.gps) {
    send(gps_, sensors_.fix(*measurements.gps));
  }
  if (measurements.truth) {
    send(truth_fix_, sensors_.fix(*measurements.truth));
  }
  for (const sim::WheelReading& earlier : measurements.earlier_wheels) {
    send(joints_, sensors_.joints(earlier.sample, earlier.angle_rad));
  }
  if (measurements.wheel) {
    send(joints_, sensors_.joints(*measurements.wheel, measurements.wheel_angle_rad));
    send(truth_odometry_, sensors_.truth(truth));
  }
  send(imu_, sensors_.imu(measurements.imu));
}

void SensorPublisher::publishClock(Nanoseconds stamp) {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (!clock_ || now - told_clock_ < kClockInterval) {
    return;
  }
  told_clock_ = now;
  rosgraph_msgs::Clock clock;
  clock.clock = toRosTime(stamp);
  send(*clock_, clock);
}

}  // namespace slipnav
