#pragma once
/// Inputs of the filter besides mechanized steps, and its outputs.

#include <array>
#include <cstdint>
#include <optional>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/ekf/error_state.h"
#include "slipnav/core/ekf/models/body_motion.h"
#include "slipnav/core/ekf/models/noise_factors.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// Where an estimate starts.
struct InitialState {
  NavigationState nav;
  VehicleState vehicle;
  ErrorCovariance P = ErrorCovariance::Identity();
  Geodetic origin;                   ///< of the map frame
  double standstill_variance = 0.0;  ///< learned variance of the velocity at standstill [m²/s²]; 0: not learned yet
};

/// A position, and possibly a heading, from outside that overrides the filter's.
struct PoseOverride {
  Geodetic position;  ///< of the IMU
  double position_std_m = 0.0;
  std::optional<double> heading_rad;  ///< clockwise from north; if absent the present one stays
  double heading_std_rad = 0.0;
};

/// Mean wheel motion over the interval that ends at `stamp`, from whichever message.
struct WheelMotion {
  Nanoseconds stamp = 0;
  PlanarMotion motion;
  double largest_speed_mps = 0.0;  ///< of any wheel, magnitude
  std::size_t count = 0;           ///< number of wheels below; 0 when only a speed is known
  std::array<double, kMaxWheels> circumferential_mps = {};
};

WheelMotion toWheelMotion(const WheelGeometry& geometry, const WheelSample& sample);
WheelMotion toWheelMotion(const SpeedSample& sample);

/// The kinds of measurement that are gated and counted separately.
enum Component : int {
  kForwardSpeed = 0,
  kYawRate,
  kLateral,
  kVertical,
  kZeroVelocity,
  kZeroRate,
  kFixPosition,
  kFixVelocity,
  kComponents
};

inline const char* componentName(Component component) {
  constexpr std::array<const char*, kComponents> kNames = {
      "forward_speed", "yaw_rate", "lateral", "vertical", "zero_velocity", "zero_rate", "fix_position", "fix_velocity"};
  return kNames[component];
}

/// Results of one kind of measurement.
struct ComponentStatus {
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;
  std::uint64_t opened = 0;        ///< accepted ones for which the covariance was inflated
  double nis_sum = 0.0;            ///< over the accepted ones, each divided by its degrees of freedom
  double last_nis = 0.0;           ///< likewise, accepted or not
  Nanoseconds rejected_since = 0;  ///< 0 while the last one was accepted

  std::uint64_t measured() const { return accepted + rejected; }
};

/// The filter's estimate at the end of one step.
struct Estimate {
  bool first = false;  ///< since the start
  NavigationState nav;
  Vector3 f_ib_b = Vector3::Zero();      ///< bias-corrected mean specific force of the step [m/s²]
  Vector3 omega_ib_b = Vector3::Zero();  ///< bias-corrected mean rate of the step [rad/s]
  VehicleState vehicle;
  NoiseFactors noise_factors;  ///< learned, see NoiseScales
  bool stationary = false;
  bool stuck = false;             ///< it stands while the wheels turn
  bool wheel_speed_used = false;  ///< the forward speed of that sample passed its gate
  bool has_wheels = false;        ///< a wheel sample ended in this step
  WheelMotion wheels;             ///< the last one
  BodyMotion motion;              ///< means over its interval, vehicle reference point, IMU axes
};

}  // namespace slipnav
