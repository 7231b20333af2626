#include "core/stopping/rover_observation.h"

#include <cmath>

namespace slipnav {

RoverObservation observationOf(const Estimate& estimate, const ErrorCovariance& P, double wheel_speed_at_rest_mps) {
  RoverObservation observation;
  observation.stamp = estimate.nav.stamp;
  observation.forward_mps = estimate.motion.v_eb_b.x();
  observation.speed_std_mps = std::sqrt(P.diagonal().segment<3>(kVelocity).mean());
  observation.stationary = estimate.stationary;
  observation.has_wheels = estimate.has_wheels;
  observation.wheels_at_rest =
      estimate.wheels.count > 0 && estimate.wheels.largest_speed_mps <= wheel_speed_at_rest_mps;
  return observation;
}

}  // namespace slipnav
