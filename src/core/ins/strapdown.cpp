#include "slipnav/core/ins/strapdown.h"

#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

/// Body-axes increments over one interval: rotation vector, and velocity change in the body axes at its start.
struct Increments {
  Vector3 phi_b;
  Vector3 dv_b;
};

/// (1/T) ∫ C_b(t)_to_b(0) dt for a constant turn by alpha over the interval, applied to v (Groves 5.84).
Vector3 resolveAlongTurn(const Vector3& alpha, const Vector3& v) {
  const double angle2 = alpha.squaredNorm();
  double a = 0.5 - angle2 / 24.0;
  double b = 1.0 / 6.0 - angle2 / 120.0;
  if (angle2 > 1e-4) {
    const double angle = std::sqrt(angle2);
    a = (1.0 - std::cos(angle)) / angle2;
    b = (angle - std::sin(angle)) / (angle2 * angle);
  }
  const Vector3 turned = alpha.cross(v);
  return v + a * turned + b * alpha.cross(turned);
}

/// Rates that vary linearly over two adjoining intervals T1, T2 give coning ½∫(α×ω)dt = k α1×α2 and sculling
/// k (α1×υ2 + υ1×α2) with k = T2² / (6 T1 (T1+T2)), which is the customary 1/12 for equal intervals.
///
/// An IMU away from its configured place feels in addition α × l + ω × (ω × l) (Groves 4.4.4, size effect). The change
/// of the mean rate stands for ∫α dt: over many intervals it adds up to ω(t) − ω(0), whatever its noise.
Increments increments(const NavigationState& state, const ImuInterval& previous, const ImuInterval& current) {
  const double T = current.duration_s;
  const Vector3 omega = current.omega_ib_b - state.gyro_bias_b;
  const Vector3 alpha = omega * T;
  Vector3 upsilon = (current.f_ib_b - state.accel_bias_b - omega.cross(omega.cross(state.imu_offset_b))) * T;
  if (previous.duration_s > 0.0) {
    upsilon -= (current.omega_ib_b - previous.omega_ib_b).cross(state.imu_offset_b);
  }
  Increments result{alpha, resolveAlongTurn(alpha, upsilon)};
  const double T1 = previous.duration_s;
  if (T1 > 0.0) {
    const Vector3 alpha1 = (previous.omega_ib_b - state.gyro_bias_b) * T1;
    const Vector3 upsilon1 = (previous.f_ib_b - state.accel_bias_b) * T1;
    const double k = T * T / (6.0 * T1 * (T1 + T));
    result.phi_b += k * alpha1.cross(alpha);
    result.dv_b += k * (alpha1.cross(upsilon) + upsilon1.cross(alpha));
  }
  return result;
}

Geodetic advance(const Planet& planet, const Geodetic& start, const Vector3& v_eb_n, double duration_s) {
  Geodetic end;
  const double mean_height_m = start.height_m - 0.5 * duration_s * v_eb_n.z();
  const double north_m = planet.meridianRadius(start.latitude_rad) + mean_height_m;
  end.latitude_rad = start.latitude_rad + duration_s * v_eb_n.x() / north_m;
  const double mean_latitude_rad = 0.5 * (start.latitude_rad + end.latitude_rad);
  const double east_m = planet.transverseRadius(mean_latitude_rad) + mean_height_m;
  end.longitude_rad = wrapToPi(start.longitude_rad + duration_s * v_eb_n.y() / (east_m * std::cos(mean_latitude_rad)));
  end.height_m = start.height_m - duration_s * v_eb_n.z();
  return end;
}

}  // namespace

bool isFinite(const NavigationState& s) {
  return s.q_b_to_n.coeffs().allFinite() && s.v_eb_n.allFinite() && s.accel_bias_b.allFinite() &&
         s.gyro_bias_b.allFinite() && s.imu_offset_b.allFinite() && std::isfinite(s.position.latitude_rad) &&
         std::isfinite(s.position.longitude_rad) && std::isfinite(s.position.height_m);
}

NavigationState Strapdown::propagate(const NavigationState& state, const ImuInterval& previous,
                                     const ImuInterval& current, Nanoseconds stamp) const {
  const double T = current.duration_s;
  const Increments body = increments(state, previous, current);
  const Vector3 dv_n_unturned = state.q_b_to_n * body.dv_b;

  // Velocity and position at mid-interval, good to first order, for everything that changes slowly.
  const Vector3 start_rate =
      2.0 * planet_.omega_ie_n(state.position.latitude_rad) + planet_.omega_en_n(state.position, state.v_eb_n);
  const Vector3 g_n_start = planet_.gravity_n(state.position);
  const Vector3 v_mid = state.v_eb_n + 0.5 * (dv_n_unturned + (g_n_start - start_rate.cross(state.v_eb_n)) * T);
  const Geodetic mid = advance(planet_, state.position, 0.5 * (state.v_eb_n + v_mid), 0.5 * T);
  const Vector3 omega_ie_n = planet_.omega_ie_n(mid.latitude_rad);
  const Vector3 omega_en_n = planet_.omega_en_n(mid, v_mid);
  const Vector3 zeta_n = (omega_ie_n + omega_en_n) * T;

  NavigationState next = state;
  next.stamp = stamp;
  next.q_b_to_n =
      (quaternionFromRotationVector(-zeta_n) * state.q_b_to_n * quaternionFromRotationVector(body.phi_b)).normalized();
  next.v_eb_n = state.v_eb_n + dv_n_unturned - 0.5 * zeta_n.cross(dv_n_unturned) +
                (planet_.gravity_n(mid) - (2.0 * omega_ie_n + omega_en_n).cross(v_mid)) * T;
  next.position = advance(planet_, state.position, 0.5 * (state.v_eb_n + next.v_eb_n), T);
  return next;
}

}  // namespace slipnav
