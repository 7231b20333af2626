#include "ros/messages/simulated_sensors.h"

#include <stdexcept>
#include <string>

#include "ros/messages/conversions.h"

namespace slipnav {
namespace {

Matrix3 frdToFlu() { return Vector3(1.0, -1.0, -1.0).asDiagonal(); }

}  // namespace

SimulatedSensors::SimulatedSensors(const Config& config)
    : frames_(config.frames), wheels_(config.wheels), mount_(config.imu.mount), planet_(Planet::byName(config.planet)) {
  const std::size_t count = sim::wheelsOf(config.simulator.vehicle.layout);
  if (wheels_.size() != count) {
    throw std::invalid_argument("wheels: the simulated rover has " + std::to_string(count) + ", not " +
                                std::to_string(wheels_.size()));
  }
}

sensor_msgs::Imu SimulatedSensors::imu(const ImuSample& sample) const {
  sensor_msgs::Imu message;
  message.header.stamp = toRosTime(sample.stamp);
  message.header.frame_id = frames_.imu;
  message.orientation_covariance[0] = -1.0;  // no attitude
  const Vector3 f = mount_.toSensor(sample.f_ib_b);
  const Vector3 omega = mount_.toSensor(sample.omega_ib_b);
  message.linear_acceleration.x = f.x();
  message.linear_acceleration.y = f.y();
  message.linear_acceleration.z = f.z();
  message.angular_velocity.x = omega.x();
  message.angular_velocity.y = omega.y();
  message.angular_velocity.z = omega.z();
  return message;
}

sensor_msgs::JointState SimulatedSensors::joints(const WheelSample& sample, const sim::EncoderAngles& angle_rad) const {
  sensor_msgs::JointState message;
  message.header.stamp = toRosTime(sample.stamp);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const WheelParams& wheel = wheels_[i];
    message.name.push_back(wheel.name);
    message.position.push_back(wheel.sign * angle_rad[i]);
    message.velocity.push_back(wheel.sign * sample.rate_radps[i]);
  }
  return message;
}

sensor_msgs::NavSatFix SimulatedSensors::fix(const GnssFix& fix) const {
  sensor_msgs::NavSatFix message;
  fill(fix, frames_.gps, message);
  return message;
}

nav_msgs::Odometry SimulatedSensors::truth(const sim::TruthState& truth) {
  if (!map_) {
    map_.emplace(planet_, truth.position);
  }
  Output pose;
  pose.stamp = truth.stamp;
  pose.position_enu_m = map_->toEnu(truth.position);
  pose.q_flu_to_enu = Quaternion(map_->C_n_to_enu(truth.position) * truth.q_b_to_n.toRotationMatrix() * frdToFlu());
  pose.velocity_flu_mps = swapFrdFlu(truth.v_eb_b);
  pose.angular_rate_flu_radps =
      swapFrdFlu(truth.omega_ib_b - truth.q_b_to_n.conjugate() * planet_.omega_ie_n(truth.position.latitude_rad));
  nav_msgs::Odometry message;
  fill(pose, frames_, message);
  message.header.frame_id = frames_.map;
  return message;
}

}  // namespace slipnav
