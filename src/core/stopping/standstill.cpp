#include "core/stopping/standstill.h"

namespace slipnav {

void Standstill::observe(const RoverObservation& observation) {
  newest_ = observation.stamp;
  standing_ = observation.stationary;
  zero_updates_ = standing_ ? zero_updates_ + (observation.has_wheels ? 1 : 0) : 0;
  if (standing_ || !observation.wheels_at_rest) {
    unaccepted_since_.reset();
  } else if (!unaccepted_since_) {
    unaccepted_since_ = observation.stamp;
  }
}

}  // namespace slipnav
