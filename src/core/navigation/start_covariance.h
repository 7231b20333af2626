#pragma once
/// Correlated uncertainty of a start.

#include "core/base/square.h"
#include "slipnav/core/earth/planet.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// The residual accelerometer bias tilts the level by bias over gravity, and the two errors stay correlated: the
/// filter must not take the same specific force as new information about both.
/// @param attitudeOf attitude leveled with an accelerometer bias, body axes [m/s²]
/// @param initial leveled with its own bias; the variance of that bias moves from P's diagonal into the correlation
template <class AttitudeOf>
void tieLevelToAccelBias(const Planet& planet, const AttitudeOf& attitudeOf, InitialState& initial) {
  constexpr double kStep_mps2 = 1e-3;
  const Vector3 variance = initial.P.diagonal().segment<3>(kAccelBias);
  initial.P.block<3, 3>(kAccelBias, kAccelBias).setZero();
  for (int axis = 0; axis < 3; ++axis) {
    NavigationState truth = initial.nav;
    truth.accel_bias_b(axis) += kStep_mps2;
    truth.q_b_to_n = attitudeOf(truth.accel_bias_b);
    const ErrorVector per_mps2 = errorBetween(planet, initial.nav, truth) / kStep_mps2;
    initial.P += variance(axis) * per_mps2 * per_mps2.transpose();
  }
}

/// A rate at rest far beyond the configured bias is the bias. It only becomes the filter's starting point, with a
/// standard deviation equal to the difference: the filter has yet to see the samples it comes from.
/// @param rate mean at rest, body axes [rad/s]
void believeSurprisingBias(const Vector3& rate, InitialState& initial);

}  // namespace slipnav
