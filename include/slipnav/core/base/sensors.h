#pragma once
/// Sensor samples in core units and axes. ROS messages, recordings and the simulator are all converted to these.
///
/// Body axes b are forward-right-down (FRD) of the vehicle; see doc/conventions.md.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Mean specific force and mean angular rate over the interval that ends at `stamp`.
struct ImuSample {
  Nanoseconds stamp = 0;
  Vector3 f_ib_b = Vector3::Zero();      ///< specific force [m/s²], body axes
  Vector3 omega_ib_b = Vector3::Zero();  ///< angular rate w.r.t. inertial space [rad/s], body axes
};

/// Upper limit for the number of driven wheels of a vehicle; fixed so that samples need no heap.
inline constexpr std::size_t kMaxWheels = 12;

/// Mean wheel motion over the interval that ends at `stamp`. Wheels are in the order of the configuration.
struct WheelSample {
  Nanoseconds stamp = 0;
  std::size_t count = 0;                           ///< number of wheels filled in below
  std::array<double, kMaxWheels> rate_radps = {};  ///< angular rate, positive when rolling forward [rad/s]
};

/// Mean forward speed over the interval that ends at `stamp`, from a robot that publishes only that.
struct SpeedSample {
  Nanoseconds stamp = 0;
  double forward_mps = 0.0;
};

/// A satellite position fix of the antenna, with its covariance in local north-east-down [m²].
struct GnssFix {
  Nanoseconds stamp = 0;
  double latitude_deg = 0.0;  ///< geodetic, as in sensor_msgs/NavSatFix
  double longitude_deg = 0.0;
  double height_m = 0.0;  ///< above the ellipsoid
  Matrix3 covariance_ned_m2 = Matrix3::Identity();
};

/// Stamp of any kind of sample.
template <class... Samples>
Nanoseconds stampOf(const std::variant<Samples...>& sample) {
  return std::visit([](const auto& s) { return s.stamp; }, sample);
}

}  // namespace slipnav
