#include "ros/messages/legacy_messages.h"

#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

/// Between east-north-up and north-east-down, and its own inverse.
Matrix3 enuToNed() { return (Matrix3() << 0, 1, 0, 1, 0, 0, 0, 0, -1).finished(); }

/// Between forward-left-up and forward-right-down, and its own inverse.
Matrix3 fluToFrd() { return Vector3(1.0, -1.0, -1.0).asDiagonal(); }

Matrix3 attitudeOf(const NavState& state) {
  const geometry_msgs::Quaternion& q = state.orientation;
  return enuToNed() * Quaternion(q.w, q.x, q.y, q.z).toRotationMatrix() * fluToFrd();
}

Vector3 velocityOf(const NavState& state) {
  return enuToNed() * Vector3(state.velocity.x, state.velocity.y, state.velocity.z);
}

/// Planet-fixed coordinates [m], Groves (2.112). In more digits than a double has: one of these coordinates on Earth
/// has steps of 1e-9 m, and in doubles the result would be off by three of them.
Vector3 ecefFrom(const NavState& state, long double equatorial_radius_m, long double flattening) {
  const long double rad_per_deg = std::acos(-1.0L) / 180.0L;
  const long double latitude_rad = state.latitude_deg * rad_per_deg;
  const long double longitude_rad = state.longitude_deg * rad_per_deg;
  const long double e2 = flattening * (2.0L - flattening);
  const long double sine = std::sin(latitude_rad);
  const long double transverse_m = equatorial_radius_m / std::sqrt(1.0L - e2 * sine * sine);
  const long double to_axis_m = (transverse_m + state.height_m) * std::cos(latitude_rad);
  return {static_cast<double>(to_axis_m * std::cos(longitude_rad)),
          static_cast<double>(to_axis_m * std::sin(longitude_rad)),
          static_cast<double>(((1.0L - e2) * transverse_m + state.height_m) * sine)};
}

}  // namespace

LegacyMessages::LegacyMessages(const FrameNames& frames, const Planet& planet, const std::vector<WheelParams>& wheels)
    : frames_(frames), equatorial_radius_m_(planet.equatorialRadius()), flattening_(planet.flattening()) {
  for (const WheelParams& wheel : wheels) {
    is_rear_.push_back(wheel.x_m < 0.0);
  }
}

geometry_msgs::PointStamped LegacyMessages::point(const std_msgs::Header& source, const Vector3& value) const {
  geometry_msgs::PointStamped message;
  message.header.stamp = source.stamp;
  message.header.frame_id = frames_.odom;
  message.point.x = value.x();
  message.point.y = value.y();
  message.point.z = value.z();
  return message;
}

geometry_msgs::PointStamped LegacyMessages::position(const NavState& state) const {
  return point(state.header, {degToRad(state.latitude_deg), degToRad(state.longitude_deg), state.height_m});
}

geometry_msgs::PointStamped LegacyMessages::llh(const NavState& state) const {
  return point(state.header, {state.latitude_deg, state.longitude_deg, state.height_m});
}

geometry_msgs::PointStamped LegacyMessages::ecef(const NavState& state) const {
  return point(state.header, ecefFrom(state, equatorial_radius_m_, flattening_));
}

geometry_msgs::PointStamped LegacyMessages::enu(const NavState& state) const {
  return point(state.header, {state.position.x, state.position.y, state.position.z});
}

geometry_msgs::PointStamped LegacyMessages::velocity(const NavState& state) const {
  return point(state.header, velocityOf(state));
}

geometry_msgs::PointStamped LegacyMessages::attitude(const NavState& state) const {
  return point(state.header, eulerFrom_q_b_to_n(Quaternion(attitudeOf(state))));
}

nav_msgs::Odometry LegacyMessages::odometry(const NavState& state) const {
  const Vector3 v_n = velocityOf(state);
  const Quaternion q(attitudeOf(state));
  nav_msgs::Odometry message;
  message.header.stamp = state.header.stamp;
  message.header.frame_id = frames_.odom;
  message.child_frame_id = frames_.imu;
  message.pose.pose.position.x = state.position.y;
  message.pose.pose.position.y = -state.position.x;
  message.pose.pose.position.z = -state.position.z;
  message.pose.pose.orientation.w = q.w();
  message.pose.pose.orientation.x = q.x();
  message.pose.pose.orientation.y = q.y();
  message.pose.pose.orientation.z = q.z();
  message.twist.twist.linear.x = v_n.x();
  message.twist.twist.linear.y = -v_n.y();
  message.twist.twist.linear.z = -v_n.z();
  return message;
}

std::optional<geometry_msgs::PointStamped> LegacyMessages::slip(const Slip& slip) const {
  const std::size_t wheels = slip.wheel_speed_mps.size();
  if (wheels != is_rear_.size() || slip.ratio.size() != wheels) {
    return std::nullopt;
  }
  double worst = 0.0;
  double rear_mps = 0.0;
  double rear_wheels = 0.0;
  for (std::size_t i = 0; i < wheels; ++i) {
    worst = std::abs(slip.ratio[i]) > std::abs(worst) ? slip.ratio[i] : worst;  // undefined ones are not
    rear_mps += is_rear_[i] ? slip.wheel_speed_mps[i] : 0.0;
    rear_wheels += is_rear_[i] ? 1.0 : 0.0;
  }
  if (rear_wheels == 0.0) {
    return std::nullopt;
  }
  return point(slip.header, {worst, rear_mps / rear_wheels, slip.forward_speed_mps});
}

}  // namespace slipnav
