#include "slipnav/ros/sensor_publisher.h"

#include <rosgraph_msgs/Clock.h>

#include <boost/make_shared.hpp>

#include "slipnav/ros/conversions.h"

namespace slipnav {
namespace {

constexpr std::uint32_t kQueueSize = 10000;

template <class Message>
void send(const ros::Publisher& publisher, Message message) {
  publisher.publish(boost::shared_ptr<const Message>(boost::make_shared<Message>(std::move(message))));
}

}  // namespace

SensorPublisher::SensorPublisher(ros::NodeHandle& node, const Config& config)
    : sensors_(config),
      clock_(node.advertise<rosgraph_msgs::Clock>("/clock", kQueueSize)),
      imu_(node.advertise<sensor_msgs::Imu>(config.topics.imu, kQueueSize)),
      joints_(node.advertise<sensor_msgs::JointState>(config.topics.joint_states, kQueueSize)),
      gps_(node.advertise<sensor_msgs::NavSatFix>(config.topics.gps_fix, kQueueSize)),
      truth_fix_(node.advertise<sensor_msgs::NavSatFix>(config.topics.truth_fix, kQueueSize)),
      truth_odometry_(node.advertise<nav_msgs::Odometry>(config.topics.truth_odometry, kQueueSize)) {}

void SensorPublisher::publish(const sim::Measurements& measurements, const sim::TruthState& truth) {
  rosgraph_msgs::Clock clock;
  clock.clock = toRosTime(truth.stamp);
  send(clock_, clock);
  if (measurements.gps) {
    send(gps_, sensors_.fix(*measurements.gps));
  }
  if (measurements.truth) {
    send(truth_fix_, sensors_.fix(*measurements.truth));
  }
  if (measurements.wheel) {
    send(joints_, sensors_.joints(*measurements.wheel, measurements.wheel_angle_rad));
    send(truth_odometry_, sensors_.truth(truth));
  }
  send(imu_, sensors_.imu(measurements.imu));
}

}  // namespace slipnav
