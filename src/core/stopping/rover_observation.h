#pragma once
/// What the stop supervisor needs to know about the rover, from each estimate of the filter.

#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// One estimate, reduced to what stops depend on.
struct RoverObservation {
  Nanoseconds stamp = 0;        ///< of the estimate
  double forward_mps = 0.0;     ///< over ground, mean over the last wheel interval
  double speed_std_mps = 0.0;   ///< 1σ of the velocity, root of the mean variance of its axes
  bool stationary = false;      ///< the filter considers the rover at standstill
  bool has_wheels = false;      ///< a wheel interval ended in its step; at standstill, a zero update was accepted
  bool wheels_at_rest = false;  ///< no wheel turned in the last wheel interval; false if wheels are not known
};

/// @param wheel_speed_at_rest_mps highest circumferential speed of a wheel at rest, see StationaryParams
RoverObservation observationOf(const Estimate& estimate, const ErrorCovariance& P, double wheel_speed_at_rest_mps);

}  // namespace slipnav
