#pragma once
/// Motion over the ellipsoid in closed form, and what an ideal IMU says about it.

#include <functional>
#include <vector>

#include "slipnav/core/ins/nav_state.h"
#include "slipnav/core/ins/strapdown.h"

namespace slipnav::test {

/// offset + rate·t + amplitude·sin(frequency·t + phase), with its derivatives.
struct Wave {
  double offset = 0.0;
  double rate = 0.0;
  double amplitude = 0.0;
  double frequency_radps = 0.0;
  double phase_rad = 0.0;

  double at(double t_s) const;
  double first(double t_s) const;
  double second(double t_s) const;
};

inline Wave constant(double value) { return {value, 0.0, 0.0, 0.0, 0.0}; }
inline Wave steady(double value, double rate) { return {value, rate, 0.0, 0.0, 0.0}; }

/// Attitude w.r.t. north-east-down at one instant.
struct AttitudeMotion {
  Quaternion q_b_to_n = Quaternion::Identity();
  Vector3 omega_nb_b = Vector3::Zero();  ///< [rad/s]
};
using AttitudeFunction = std::function<AttitudeMotion(double t_s)>;

/// Roll, pitch and yaw as waves.
AttitudeFunction eulerAttitude(const Wave& roll, const Wave& pitch, const Wave& yaw);

/// The body's z axis runs around a cone of half-angle `angle_rad` without turning about itself:
/// rotation vector angle·(cos ωt, sin ωt, 0).
AttitudeFunction coningAttitude(double angle_rad, double frequency_radps);

class AnalyticMotion {
 public:
  AnalyticMotion(const Planet& planet, AttitudeFunction attitude, const Wave& latitude_rad, const Wave& longitude_rad,
                 const Wave& height_m);

  /// The true state; its stamp is `t_s` after kEpoch, its biases are zero.
  NavigationState state(double t_s) const;

  /// Mean specific force and rate over [from, to], by 8-point Gauss–Legendre quadrature of the exact values.
  ImuInterval imu(double from_s, double to_s) const;

  const Planet& planet() const { return planet_; }

  static constexpr Nanoseconds kEpoch = 1'600'000'000'000'000'000;

 private:
  Vector3 velocity_n(double t_s) const;
  Vector3 acceleration_n(double t_s) const;  ///< d/dt of the components of velocity_n
  Vector3 omega_in_n(double t_s) const;

  Planet planet_;
  AttitudeFunction attitude_;
  Wave latitude_rad_;
  Wave longitude_rad_;
  Wave height_m_;
};

/// Mechanizes the motion's own IMU over intervals that end at `ends_s`, from the true state at time zero.
/// @param start_s where the interval before the first begins; the mechanization knows it as previous interval
NavigationState mechanize(const AnalyticMotion& motion, const std::vector<double>& ends_s, double start_s);

/// The same over regular intervals.
NavigationState mechanize(const AnalyticMotion& motion, double duration_s, double rate_hz);

}  // namespace slipnav::test
