#pragma once
/// What the core_nav node of the paper's software publishes, derived from this package's messages: its types, axes and
/// units. North, east and down are those of the map frame, at the start.

#include <geometry_msgs/PointStamped.h>
#include <nav_msgs/Odometry.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>

#include <optional>
#include <string>
#include <vector>

#include "config/frames.h"
#include "slipnav/core/earth/planet.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// Makes the legacy messages; every header has the stamp of its source and the frame `frames.odom`.
class LegacyMessages {
 public:
  LegacyMessages(const FrameNames& frames, const Planet& planet, const std::vector<WheelParams>& wheels);

  /// Latitude [rad], longitude [rad], height above the ellipsoid [m].
  geometry_msgs::PointStamped position(const NavState& state) const;
  /// Latitude [°], longitude [°], height above the ellipsoid [m].
  geometry_msgs::PointStamped llh(const NavState& state) const;
  /// Planet-fixed coordinates [m].
  geometry_msgs::PointStamped ecef(const NavState& state) const;
  /// East, north, up about the start [m].
  geometry_msgs::PointStamped enu(const NavState& state) const;
  /// North, east, down [m/s].
  geometry_msgs::PointStamped velocity(const NavState& state) const;
  /// Roll, pitch, yaw of forward-right-down in north-east-down [rad].
  geometry_msgs::PointStamped attitude(const NavState& state) const;
  /// Position north, −east, −up [m]; velocity north, −east, −down [m/s]; orientation in the same axes as attitude();
  /// no covariance.
  nav_msgs::Odometry odometry(const NavState& state) const;
  /// Slip ratio of the wheel that slips most, speed of the rear wheels [m/s], forward speed over ground [m/s]. Nothing
  /// if the speeds of single wheels are not known.
  std::optional<geometry_msgs::PointStamped> slip(const Slip& slip) const;

 private:
  geometry_msgs::PointStamped point(const std_msgs::Header& source, const Vector3& value) const;

  FrameNames frames_;
  double equatorial_radius_m_;
  double flattening_;
  std::vector<bool> is_rear_;  ///< in the order of the configuration
};

}  // namespace slipnav
