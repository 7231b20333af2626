#include "slipnav/ros/bag_writer.h"

#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>

#include <cstdio>
#include <optional>
#include <stdexcept>

#include "slipnav/ros/conversions.h"

namespace slipnav {
namespace {

Matrix3 frdToFlu() { return Vector3(1.0, -1.0, -1.0).asDiagonal(); }

/// A recording has absolute names.
std::string absolute(const std::string& topic) { return topic.front() == '/' ? topic : "/" + topic; }

}  // namespace

struct BagWriter::Parts {
  std::string path;
  Config config;
  Planet planet;
  ImuMount mount;
  rosbag::Bag bag;
  std::optional<LocalFrame> frame;
  bool complete = false;

  Parts(const std::string& file, const Config& c)
      : path(file), config(c), planet(Planet::byName(c.planet)), mount(c.imu.mount) {}

  ~Parts() {
    if (!complete) {
      bag.close();
      std::remove(path.c_str());
    }
  }

  template <class Message>
  void put(const std::string& topic, const Message& message) {
    bag.write(absolute(topic), message.header.stamp, message);
  }

  void putImu(const ImuSample& sample) {
    sensor_msgs::Imu message;
    message.header.stamp = toRosTime(sample.stamp);
    message.header.frame_id = config.frames.imu;
    message.orientation_covariance[0] = -1.0;  // no attitude
    const Vector3 f = mount.toSensor(sample.f_ib_b);
    const Vector3 omega = mount.toSensor(sample.omega_ib_b);
    message.linear_acceleration.x = f.x();
    message.linear_acceleration.y = f.y();
    message.linear_acceleration.z = f.z();
    message.angular_velocity.x = omega.x();
    message.angular_velocity.y = omega.y();
    message.angular_velocity.z = omega.z();
    put(config.topics.imu, message);
  }

  void putWheels(const WheelSample& sample, const sim::PerWheel& angle_rad) {
    sensor_msgs::JointState message;
    message.header.stamp = toRosTime(sample.stamp);
    for (std::size_t i = 0; i < config.wheels.size(); ++i) {
      const WheelParams& wheel = config.wheels[i];
      message.name.push_back(wheel.name);
      message.position.push_back(wheel.sign * angle_rad[i]);
      message.velocity.push_back(wheel.sign * sample.rate_radps[i]);
    }
    put(config.topics.joint_states, message);
  }

  void putFix(const std::string& topic, const GnssFix& fix) {
    sensor_msgs::NavSatFix message;
    fill(fix, config.frames.gps, message);
    put(topic, message);
  }

  void putTruth(const sim::TruthState& truth) {
    if (!frame) {
      frame.emplace(planet, truth.position);
    }
    Output pose;
    pose.stamp = truth.stamp;
    pose.position_enu_m = frame->toEnu(truth.position);
    pose.q_flu_to_enu = Quaternion(frame->C_n_to_enu(truth.position) * truth.q_b_to_n.toRotationMatrix() * frdToFlu());
    pose.velocity_flu_mps = swapFrdFlu(truth.v_eb_b);
    pose.angular_rate_flu_radps =
        swapFrdFlu(truth.omega_ib_b - truth.q_b_to_n.conjugate() * planet.omega_ie_n(truth.position.latitude_rad));
    nav_msgs::Odometry message;
    fill(pose, config.frames, message);
    message.header.frame_id = config.frames.map;
    put(config.topics.truth_odometry, message);
  }
};

BagWriter::BagWriter(const std::string& path, const Config& config) : parts_(std::make_unique<Parts>(path, config)) {
  if (config.wheels.size() != sim::kWheelCount) {
    throw std::invalid_argument("wheels: the simulated rover has " + std::to_string(sim::kWheelCount) + ", not " +
                                std::to_string(config.wheels.size()));
  }
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
  if (measurements.gps) {
    parts_->putFix(parts_->config.topics.gps_fix, *measurements.gps);
  }
  if (measurements.truth) {
    parts_->putFix(parts_->config.topics.truth_fix, *measurements.truth);
  }
  if (measurements.wheel) {
    parts_->putWheels(*measurements.wheel, measurements.wheel_angle_rad);
    parts_->putTruth(truth);
  }
  parts_->putImu(measurements.imu);
}

void BagWriter::close() {
  parts_->bag.close();
  parts_->complete = true;
}

}  // namespace slipnav
