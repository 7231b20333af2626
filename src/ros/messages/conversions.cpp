#include "ros/messages/conversions.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

constexpr double kUnknownFixStdHorizontal_m = 5.0;
constexpr double kUnknownFixStdVertical_m = 10.0;
constexpr double kUnknownVelocityStdHorizontal_mps = 0.1;
constexpr double kUnknownVelocityStdVertical_mps = 0.2;
constexpr double kFullTurn_deg = 360.0;

template <class Message>
Vector3 toVector(const Message& message) {
  return {message.x, message.y, message.z};
}

template <class Message>
void fillVector(const Vector3& v, Message& message) {
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
}

geometry_msgs::Quaternion toQuaternionMessage(const Quaternion& q) {
  geometry_msgs::Quaternion message;
  message.w = q.w();
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  return message;
}

/// Row-major, into an array of the right length.
template <class Derived, class Array>
void fillMatrix(const Eigen::MatrixBase<Derived>& m, Array& array) {
  for (Eigen::Index row = 0; row < m.rows(); ++row) {
    for (Eigen::Index column = 0; column < m.cols(); ++column) {
      array[static_cast<std::size_t>(row * m.cols() + column)] = m(row, column);
    }
  }
}

/// Exchanges east-north-up and north-east-down; its own inverse.
Matrix3 swapEnuNed() {
  Matrix3 m;
  m << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  return m;
}

/// What receivers report before they have a fix.
bool isNowhere(const sensor_msgs::NavSatFix& message) { return message.latitude == 0.0 && message.longitude == 0.0; }

bool isOutOfRange(const sensor_msgs::NavSatFix& message) {
  return std::abs(message.latitude) > 90.0 || std::abs(message.longitude) > 360.0;
}

Matrix3 covarianceOf(const sensor_msgs::NavSatFix& message) {
  const Matrix3 enu =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(message.position_covariance.data());
  const bool known = message.position_covariance_type != sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN &&
                     enu.allFinite() && enu.diagonal().minCoeff() > 0.0;
  if (known) {
    return swapEnuNed() * enu * swapEnuNed();
  }
  const Vector3 std_m(kUnknownFixStdHorizontal_m, kUnknownFixStdHorizontal_m, kUnknownFixStdVertical_m);
  return std_m.cwiseAbs2().asDiagonal();
}

std::optional<TruthSample> toTruthSample(const ros::Time& stamp, const geometry_msgs::Pose& pose) {
  const Quaternion q(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  TruthSample sample;
  sample.stamp = toNanoseconds(stamp);
  sample.position_enu_m = toVector(pose.position);
  if (!sample.position_enu_m.allFinite() || !q.coeffs().allFinite()) {
    return std::nullopt;
  }
  if (q.norm() > 0.5) {  // all zeros mean that the attitude is not known
    sample.q_flu_to_enu = q.normalized();
  }
  return sample;
}

double orNan(const std::optional<double>& value) { return value.value_or(std::numeric_limits<double>::quiet_NaN()); }

std::uint8_t statusOf(const Estimate& estimate, double max_wheel_interval_s) {
  if (toSeconds(estimate.nav.stamp - estimate.wheels.stamp) > max_wheel_interval_s) {
    return NavState::STATUS_INERTIAL;
  }
  if (estimate.stuck) {
    return NavState::STATUS_STUCK;
  }
  return estimate.stationary ? NavState::STATUS_STATIONARY : NavState::STATUS_MOVING;
}

}  // namespace

ImuSample toImuSample(const sensor_msgs::Imu& message, const ImuMount& mount) {
  return mount.toBody(toNanoseconds(message.header.stamp), toVector(message.linear_acceleration),
                      toVector(message.angular_velocity));
}

std::string noStamps(const std::string& topic) { return "stamps of " + topic + " are zero"; }

std::string complaintOf(const sensor_msgs::NavSatFix& message, const std::string& topic) {
  if (message.status.status < sensor_msgs::NavSatStatus::STATUS_FIX) {
    return "";
  }
  if (isNowhere(message)) {
    return topic + " is at latitude 0, longitude 0 with a good status: the receiver has no fix yet";
  }
  if (isOutOfRange(message)) {
    return topic + " has a latitude or longitude that is out of range: degrees are required";
  }
  return message.header.stamp.isZero() ? noStamps(topic) : "";
}

std::optional<GnssFix> toGnssFix(const sensor_msgs::NavSatFix& message) {
  const bool finite =
      std::isfinite(message.latitude) && std::isfinite(message.longitude) && std::isfinite(message.altitude);
  if (message.status.status < sensor_msgs::NavSatStatus::STATUS_FIX || !finite || isNowhere(message) ||
      isOutOfRange(message)) {
    return std::nullopt;
  }
  return GnssFix{toNanoseconds(message.header.stamp), message.latitude, message.longitude, message.altitude,
                 covarianceOf(message)};
}

std::optional<VelocityFix> toVelocityFix(const geometry_msgs::TwistWithCovarianceStamped& message) {
  VelocityFix fix;
  fix.stamp = toNanoseconds(message.header.stamp);
  fix.v_ea_n = swapEnuNed() * toVector(message.twist.twist.linear);
  const Vector3 variance_enu(message.twist.covariance[0], message.twist.covariance[7], message.twist.covariance[14]);
  const bool known = variance_enu.allFinite() && variance_enu.minCoeff() > 0.0;
  fix.variance_ned_m2ps2 = known ? Vector3(variance_enu.y(), variance_enu.x(), variance_enu.z())
                                 : Vector3(kUnknownVelocityStdHorizontal_mps, kUnknownVelocityStdHorizontal_mps,
                                           kUnknownVelocityStdVertical_mps)
                                       .cwiseAbs2();
  return isFinite(fix) ? std::optional(fix) : std::nullopt;
}

void fill(const GnssFix& fix, const std::string& frame_id, sensor_msgs::NavSatFix& message) {
  message.header.stamp = toRosTime(fix.stamp);
  message.header.frame_id = frame_id;
  message.status.status = sensor_msgs::NavSatStatus::STATUS_FIX;
  message.status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
  message.latitude = fix.latitude_deg;
  message.longitude = fix.longitude_deg;
  message.altitude = fix.height_m;
  const Matrix3 covariance_enu = swapEnuNed() * fix.covariance_ned_m2 * swapEnuNed();
  fillMatrix(covariance_enu, message.position_covariance);
  message.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_KNOWN;
}

std::optional<TruthSample> toTruthSample(const nav_msgs::Odometry& message) {
  return toTruthSample(message.header.stamp, message.pose.pose);
}

std::optional<TruthSample> toTruthSample(const geometry_msgs::PoseStamped& message) {
  return toTruthSample(message.header.stamp, message.pose);
}

EstimateSample toEstimateSample(const nav_msgs::Odometry& message) {
  const geometry_msgs::Quaternion& q = message.pose.pose.orientation;
  EstimateSample sample;
  sample.stamp = toNanoseconds(message.header.stamp);
  sample.position_enu_m = toVector(message.pose.pose.position);
  sample.q_flu_to_enu = Quaternion(q.w, q.x, q.y, q.z);
  sample.covariance_enu_m2 =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.pose.covariance.data())
          .topLeftCorner<3, 3>();
  sample.speed_mps = message.twist.twist.linear.x;
  return sample;
}

NavigationState toNavigationState(const nav_msgs::Odometry& message, const LocalFrame& origin,
                                  const Vector3& imu_position_b) {
  const std::optional<TruthSample> pose = toTruthSample(message);
  const Quaternion q = pose && pose->q_flu_to_enu ? *pose->q_flu_to_enu : Quaternion::Identity();
  const Matrix3 C_b_to_enu = q.toRotationMatrix() * Vector3(1.0, -1.0, -1.0).asDiagonal();
  NavigationState state;
  state.stamp = toNanoseconds(message.header.stamp);
  state.position = origin.toGeodetic(toVector(message.pose.pose.position) + C_b_to_enu * imu_position_b);
  const Matrix3 C_b_to_n = origin.C_n_to_enu(state.position).transpose() * C_b_to_enu;
  state.q_b_to_n = Quaternion(C_b_to_n);
  const Vector3 omega_b = swapFrdFlu(toVector(message.twist.twist.angular));
  state.v_eb_n = C_b_to_n * (swapFrdFlu(toVector(message.twist.twist.linear)) + omega_b.cross(imu_position_b));
  return state;
}

PoseOverride toPoseOverride(const SetStateRequest& request, const LocalFrame& map, const NavigationState& present,
                            const Vector3& lever_imu_to_base_b) {
  PoseOverride pose;
  pose.position_std_m = request.position_std_m;
  Vector3 euler = eulerFrom_q_b_to_n(present.q_b_to_n);
  if (request.has_heading != 0) {
    if (!(std::abs(request.heading_deg) <= kFullTurn_deg)) {
      throw std::invalid_argument("heading_deg must be -360 to 360");
    }
    pose.heading_rad = euler.z() = degToRad(request.heading_deg);
    pose.heading_std_rad = degToRad(request.heading_std_deg);
  }
  const Quaternion q_b_to_n = q_b_to_n_fromEuler(euler.x(), euler.y(), euler.z());
  const Vector3 lever_enu = map.C_n_to_enu(present.position) * (q_b_to_n * lever_imu_to_base_b);
  pose.position = map.toGeodetic(toVector(request.position) - lever_enu);
  return pose;
}

void fill(const Output& output, const FrameNames& frames, nav_msgs::Odometry& message) {
  message.header.stamp = toRosTime(output.stamp);
  message.header.frame_id = frames.odom;
  message.child_frame_id = frames.base;
  fillVector(output.position_enu_m, message.pose.pose.position);
  message.pose.pose.orientation = toQuaternionMessage(output.q_flu_to_enu);
  fillMatrix(output.pose_covariance, message.pose.covariance);
  fillVector(output.velocity_flu_mps, message.twist.twist.linear);
  fillVector(output.angular_rate_flu_radps, message.twist.twist.angular);
  fillMatrix(output.twist_covariance, message.twist.covariance);
}

geometry_msgs::TransformStamped toTransform(const Output& output, const FrameNames& frames) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = toRosTime(output.stamp);
  transform.header.frame_id = frames.odom;
  transform.child_frame_id = frames.base;
  fillVector(output.position_enu_m, transform.transform.translation);
  transform.transform.rotation = toQuaternionMessage(output.q_flu_to_enu);
  return transform;
}

void fill(const Estimate& estimate, const ErrorCovariance& P, const LocalFrame& frame, const FrameNames& frames,
          double max_wheel_interval_s, NavState& message) {
  const NavigationState& nav = estimate.nav;
  const Matrix3 C_n_to_enu = frame.C_n_to_enu(nav.position);
  const Matrix3 frd_to_flu = Vector3(1.0, -1.0, -1.0).asDiagonal();
  message.header.stamp = toRosTime(nav.stamp);
  message.header.frame_id = frames.map;
  message.child_frame_id = frames.base;
  message.orientation = toQuaternionMessage(Quaternion(C_n_to_enu * nav.q_b_to_n.toRotationMatrix() * frd_to_flu));
  fillVector(C_n_to_enu * nav.v_eb_n, message.velocity);
  fillVector(frame.toEnu(nav.position), message.position);
  message.latitude_deg = radToDeg(nav.position.latitude_rad);
  message.longitude_deg = radToDeg(nav.position.longitude_rad);
  message.height_m = nav.position.height_m;
  fillVector(swapFrdFlu(nav.accel_bias_b), message.accel_bias);
  fillVector(swapFrdFlu(nav.gyro_bias_b), message.gyro_bias);

  NavCovariance to_user = NavCovariance::Zero();
  for (const int block : {kAttitude, kVelocity, kPosition}) {
    to_user.block<3, 3>(block, block) = C_n_to_enu;
  }
  for (const int block : {kAccelBias, kGyroBias}) {
    to_user.block<3, 3>(block, block) = frd_to_flu;
  }
  const NavCovariance covariance = to_user * P.topLeftCorner<kNavStates, kNavStates>() * to_user.transpose();
  fillMatrix(covariance, message.covariance);

  message.wheel_scale = estimate.vehicle.wheel_scale;
  message.slow_slip = estimate.vehicle.slow_slip;
  message.fast_slip = estimate.vehicle.fast_slip;
  message.side_slip_rad = -std::atan(estimate.vehicle.side_slip);
  message.status = statusOf(estimate, max_wheel_interval_s);
}

void fill(const VehicleSlip& slip, bool stationary, const WheelGeometry& geometry, const FrameNames& frames,
          Slip& message) {
  message.header.stamp = toRosTime(slip.stamp);
  message.header.frame_id = frames.base;
  message.duration_s = slip.duration_s;
  for (std::size_t i = 0; i < slip.count; ++i) {
    message.names.push_back(geometry.wheel(i).name);
    message.ratio.push_back(orNan(slip.ratio[i]));
    message.wheel_speed_mps.push_back(slip.circumferential_mps[i]);
  }
  message.mean_ratio = orNan(slip.mean_ratio);
  message.forward_speed_mps = slip.forward_mps;
  message.slip_angle_rad = slip.angle_rad ? -*slip.angle_rad : orNan(std::nullopt);
  message.stationary = stationary;
}

}  // namespace slipnav
