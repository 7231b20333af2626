#pragma once
/// What goes into the filter beside mechanised steps, and what comes out of it.

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
  Geodetic origin;               ///< of the map frame
  double tremor_variance = 0.0;  ///< of the velocity at standstill as learned so far [m²/s²]; 0: not yet
};

/// A position, and maybe a heading, that somebody knows better than the filter.
struct Placement {
  Geodetic position;  ///< of the IMU
  double position_std_m = 0.0;
  std::optional<double> heading_rad;  ///< clockwise from north; the present one stays without
  double heading_std_rad = 0.0;
};

/// Mean wheel motion over the interval that ends at `stamp`, whatever message it came in.
struct WheelMotion {
  Nanoseconds stamp = 0;
  PlanarMotion motion;
  double largest_speed_mps = 0.0;  ///< of any wheel, magnitude
  std::size_t count = 0;           ///< number of wheels below; 0 when only a speed is known
  std::array<double, kMaxWheels> circumferential_mps = {};
};

WheelMotion toWheelMotion(const WheelGeometry& geometry, const WheelSample& sample);
WheelMotion toWheelMotion(const SpeedSample& sample);

/// The kinds of measurement that are gated and counted apart.
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

const char* componentName(Component component);

/// What became of one kind of measurement.
struct ComponentStatus {
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;
  std::uint64_t opened = 0;        ///< of the accepted ones, those that the covariance was opened for
  double nis_sum = 0.0;            ///< of the accepted ones, each divided by its degrees of freedom
  double last_nis = 0.0;           ///< likewise, accepted or not
  Nanoseconds rejected_since = 0;  ///< 0 while the last one was accepted

  std::uint64_t measured() const { return accepted + rejected; }
};

/// The filter's answer for the end of one step.
struct Estimate {
  std::uint64_t sequence = 0;
  NavigationState nav;
  Vector3 f_ib_b = Vector3::Zero();      ///< bias-free mean specific force of the step [m/s²]
  Vector3 omega_ib_b = Vector3::Zero();  ///< bias-free mean rate of the step [rad/s]
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
