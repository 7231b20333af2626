#include "ros/bag/bag_writer.h"

#include <rosbag/bag.h>

#include <cstdio>
#include <stdexcept>

#include "ros/messages/simulated_sensors.h"

namespace slipnav {
namespace {

/// Recordings have absolute names.
std::string absolute(const std::string& topic) { return topic.front() == '/' ? topic : "/" + topic; }

}  // namespace

struct BagWriter::Parts {
  std::string path;
  TopicNames topics;
  SimulatedSensors sensors;
  rosbag::Bag bag;
  bool complete = false;

  Parts(const std::string& file, const Config& config) : path(file), topics(config.topics), sensors(config) {}

  ~Parts() {
    if (!complete && bag.isOpen()) {
      bag.close();
      std::remove(path.c_str());
    }
  }

  template <class Message>
  void put(const std::string& topic, const Message& message) {
    bag.write(absolute(topic), message.header.stamp, message);
  }
};

BagWriter::BagWriter(const std::string& path, const Config& config) : parts_(std::make_unique<Parts>(path, config)) {
  try {
    parts_->bag.open(path, rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": cannot be written: " + error.what());
  }
  parts_->bag.setCompression(rosbag::compression::LZ4);
}

BagWriter::~BagWriter() = default;
BagWriter::BagWriter(BagWriter&&) noexcept = default;
BagWriter& BagWriter::operator=(BagWriter&&) noexcept = default;

void BagWriter::write(const sim::Measurements& measurements, const sim::TruthState& truth) {
  Parts& p = *parts_;
  if (measurements.gps) {
    p.put(p.topics.gps_fix, p.sensors.fix(*measurements.gps));
  }
  if (measurements.truth) {
    p.put(p.topics.truth_fix, p.sensors.fix(*measurements.truth));
  }
  for (const sim::WheelReading& earlier : measurements.earlier_wheels) {
    p.put(p.topics.joint_states, p.sensors.joints(earlier.sample, earlier.angle_rad));
  }
  if (measurements.wheel) {
    p.put(p.topics.joint_states, p.sensors.joints(*measurements.wheel, measurements.wheel_angle_rad));
    p.put(p.topics.truth_odometry, p.sensors.truth(truth));
  }
  p.put(p.topics.imu, p.sensors.imu(measurements.imu));
}

void BagWriter::close() {
  parts_->bag.close();
  parts_->complete = true;
}

}  // namespace slipnav
