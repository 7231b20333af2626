#pragma once
/// Conversions between ROS messages and the core. Nodelets and offline tools use the same functions, so that both
/// work with the same numbers bit for bit.

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>
#include <slipnav/NavState.h>
#include <slipnav/SetState.h>
#include <slipnav/Slip.h>

#include <optional>
#include <string>

#include "config/frames.h"
#include "core/sensors/imu_mount.h"
#include "core/slip/vehicle_slip.h"
#include "evaluation/estimate.h"
#include "evaluation/truth_track.h"
#include "slipnav/core/base/sensors.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/models/gnss_fix.h"
#include "slipnav/core/navigation/output.h"

namespace slipnav {

inline Nanoseconds toNanoseconds(const ros::Time& time) { return static_cast<Nanoseconds>(time.toNSec()); }
inline ros::Time toRosTime(Nanoseconds stamp) {
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(stamp));
  return time;
}

ImuSample toImuSample(const sensor_msgs::Imu& message, const ImuMount& mount);

/// Complaint about a topic whose header.stamp is zero.
std::string noStamps(const std::string& topic);

/// What is wrong with a fix that claims to be one, in one line that names its topic; otherwise, and without a
/// fix, "".
std::string complaintOf(const sensor_msgs::NavSatFix& message, const std::string& topic);

/// Nothing for a message without a fix, with a complaint, or with numbers that are not finite. Where the
/// receiver does not know its covariance, 5 m horizontally and 10 m vertically (1σ) are assumed.
std::optional<GnssFix> toGnssFix(const sensor_msgs::NavSatFix& message);

/// Linear velocity of the antenna, east, north, up. Nothing if it is not finite. Where the receiver does not know its
/// covariance (a diagonal that is not positive), 0.1 m/s horizontally and 0.2 m/s vertically (1σ) are assumed.
std::optional<VelocityFix> toVelocityFix(const geometry_msgs::TwistWithCovarianceStamped& message);

/// A fix as a message.
void fill(const GnssFix& fix, const std::string& frame_id, sensor_msgs::NavSatFix& message);

/// A pose of the truth, in whatever frame. Nothing if it is not finite.
std::optional<TruthSample> toTruthSample(const nav_msgs::Odometry& message);
std::optional<TruthSample> toTruthSample(const geometry_msgs::PoseStamped& message);

/// Pose, forward speed and covariance of the position; fields that Odometry lacks keep their default.
EstimateSample toEstimateSample(const nav_msgs::Odometry& message);

/// A true pose and velocity as the state of the IMU. The frame of the message is taken as east-north-up about `origin`.
NavigationState toNavigationState(const nav_msgs::Odometry& message, const LocalFrame& origin,
                                  const Vector3& imu_position_b);

/// The requested pose of the IMU. @param map the frame of the request; @param present gives roll and pitch
PoseOverride toPoseOverride(const SetStateRequest& request, const LocalFrame& map, const NavigationState& present,
                            const Vector3& lever_imu_to_base_b);

/// Pose in `odom`, twist in base_link; covariances in the same axes.
void fill(const Output& output, const FrameNames& frames, nav_msgs::Odometry& message);

/// The transform odom → base_link.
geometry_msgs::TransformStamped toTransform(const Output& output, const FrameNames& frames);

/// @param frame the local frame of the estimate; @param max_wheel_interval_s longer without wheels is inertial
void fill(const Estimate& estimate, const ErrorCovariance& P, const LocalFrame& frame, const FrameNames& frames,
          double max_wheel_interval_s, NavState& message);

/// @param geometry names the wheels
void fill(const VehicleSlip& slip, bool stationary, const WheelGeometry& geometry, const FrameNames& frames,
          Slip& message);

}  // namespace slipnav
