#include "slipnav/core/ekf/models/gnss_fix.h"

#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav {

void FixParams::visit(ParameterVisitor& v) {
  v.choice("use", use, {"start", "always"},
           "when gps/fix is used: start, for the start only; always, while driving as well. Never the truth topics");
  v.number("correlation_s", correlation_s, {0.0, 3600.0},
           "correlation time of the receiver error: fixes within it count as about one; 0: errors are "
           "independent [s]");
  v.number("max_wait_s", max_wait_s, {0.0, 10.0},
           "with always, how late a fix may come after the IMU of its time; with irregular fixes, estimates are "
           "this much later [s]");
}

double repeatedFixFactor(double interval_s, double correlation_s) {
  return correlation_s > 0.0 ? 1.0 / std::tanh(0.5 * interval_s / correlation_s) : 1.0;
}

bool isFinite(const PositionFix& fix) {
  return std::isfinite(fix.position.latitude_rad) && std::isfinite(fix.position.longitude_rad) &&
         std::isfinite(fix.position.height_m) && fix.variance_ned_m2.allFinite();
}

bool isFinite(const VelocityFix& fix) { return fix.v_ea_n.allFinite() && fix.variance_ned_m2ps2.allFinite(); }

PositionFix toPositionFix(const GnssFix& fix) {
  return {fix.stamp,
          {degToRad(fix.latitude_deg), degToRad(fix.longitude_deg), fix.height_m},
          fix.covariance_ned_m2.diagonal()};
}

Measurement positionMeasurement(const Planet& planet, const PositionFix& fix, const NavigationState& state,
                                const Vector3& lever_b) {
  const Vector3 lever_n = state.q_b_to_n * lever_b;
  const Vector3 travelled_n = state.v_eb_n * toSeconds(state.stamp - fix.stamp);
  const Vector3 imu_minus_fix_n = positionDifference(planet, state.position, fix.position);
  Measurement m(3);
  m.residual = -(imu_minus_fix_n + lever_n - travelled_n);
  m.H.block<3, 3>(0, kAttitude) = -skew(lever_n);
  m.H.block<3, 3>(0, kPosition).setIdentity();
  m.variance = fix.variance_ned_m2;
  return m;
}

Measurement velocityMeasurement(const Planet& planet, const VelocityFix& fix, const NavigationState& state,
                                const Vector3& f_ib_b, const Vector3& omega_ib_b, const Vector3& lever_b) {
  const double since_fix_s = toSeconds(state.stamp - fix.stamp);
  const Matrix3 C_b_to_n = state.q_b_to_n.toRotationMatrix();
  const Vector3 f_ib_n = C_b_to_n * f_ib_b;
  const Vector3 gained_n = (f_ib_n + planet.gravity_n(state.position)) * since_fix_s;
  const Vector3 omega_ie_n = planet.omega_ie_n(state.position.latitude_rad);
  const Vector3 lever_velocity_n = C_b_to_n * omega_ib_b.cross(lever_b) - omega_ie_n.cross(C_b_to_n * lever_b);
  Measurement m(3);
  m.residual = fix.v_ea_n - (state.v_eb_n + lever_velocity_n - gained_n);
  m.H.block<3, 3>(0, kAttitude) = skew(f_ib_n) * since_fix_s - skew(lever_velocity_n);
  m.H.block<3, 3>(0, kVelocity).setIdentity();
  m.H.block<3, 3>(0, kAccelBias) = C_b_to_n * since_fix_s;
  m.H.block<3, 3>(0, kGyroBias) = C_b_to_n * skew(lever_b);
  m.variance = fix.variance_ned_m2ps2;
  return m;
}

}  // namespace slipnav
