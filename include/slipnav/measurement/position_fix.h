#pragma once
/// Satellite position of the antenna (Groves 14.3.1, loosely coupled), for initialisation only.

#include "slipnav/earth/planet.h"
#include "slipnav/filter/kalman_update.h"
#include "slipnav/sensors.h"

namespace slipnav {

/// Position of the antenna and its variances, uncorrelated.
struct PositionFix {
  Nanoseconds stamp = 0;
  Geodetic position;
  Vector3 variance_ned_m2 = Vector3::Ones();
};

PositionFix toPositionFix(const GnssFix& fix);

/// Antenna position, north-east-down metres, three rows.
/// @param state at or up to one IMU interval after the fix; its position is carried back to the stamp of the fix
/// @param lever_b from the IMU to the antenna [m]
Measurement positionMeasurement(const Planet& planet, const PositionFix& fix, const NavigationState& state,
                                const Vector3& lever_b);

}  // namespace slipnav
