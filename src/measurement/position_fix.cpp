#include "slipnav/measurement/position_fix.h"

#include "slipnav/math/rotation.h"

namespace slipnav {

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

}  // namespace slipnav
