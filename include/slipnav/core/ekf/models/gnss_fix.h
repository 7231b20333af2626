#pragma once
/// Satellite position and velocity of the antenna (Groves 14.3.1, loosely coupled): for the start, and optionally
/// positions while driving.

#include <string>
#include <variant>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/earth/planet.h"
#include "slipnav/core/ekf/kalman_update.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `gnss`.
struct FixParams {
  std::string use = "start";
  double correlation_s = 10.0;
  double max_wait_s = 0.3;
  void visit(ParameterVisitor& v);

  bool always() const { return use == "always"; }
};

/// Fixes whose stamps differ by this much mean that the clock jumped: receivers are slow.
inline constexpr Nanoseconds kFixJump = 5 * kSecond;

/// Factor on the variance of a fix, `interval_s` after the last one used: receiver errors
/// are correlated, and many fixes that share one are worth little more than one. For first-order
/// Gauss-Markov errors the mean over many fixes then has the right variance: (1 + ρ)/(1 − ρ) with
/// ρ = exp(−interval/correlation).
double repeatedFixFactor(double interval_s, double correlation_s);

/// Position of the antenna and its variances, uncorrelated.
struct PositionFix {
  Nanoseconds stamp = 0;
  Geodetic position;
  Vector3 variance_ned_m2 = Vector3::Ones();
};

/// Velocity of the antenna relative to the planet and its variances, uncorrelated.
struct VelocityFix {
  Nanoseconds stamp = 0;
  Vector3 v_ea_n = Vector3::Zero();  ///< north-east-down [m/s]
  Vector3 variance_ned_m2ps2 = Vector3::Ones();
};

/// Either kind of fix.
using AntennaFix = std::variant<PositionFix, VelocityFix>;

bool isFinite(const PositionFix& fix);
bool isFinite(const VelocityFix& fix);

PositionFix toPositionFix(const GnssFix& fix);

/// Antenna position, north-east-down meters, three rows.
/// @param state at or up to one IMU interval after the fix; its position is propagated back to the stamp of the fix
/// @param lever_b from the IMU to the antenna [m]
Measurement positionMeasurement(const Planet& planet, const PositionFix& fix, const NavigationState& state,
                                const Vector3& lever_b);

/// Antenna velocity, north-east-down [m/s], three rows.
/// @param state as above; its velocity is propagated back by the acceleration of its last step
/// @param f_ib_b, omega_ib_b mean specific force [m/s²] and rate [rad/s] of that step, free of the biases in `state`
Measurement velocityMeasurement(const Planet& planet, const VelocityFix& fix, const NavigationState& state,
                                const Vector3& f_ib_b, const Vector3& omega_ib_b, const Vector3& lever_b);

}  // namespace slipnav
