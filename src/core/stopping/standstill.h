#pragma once
/// How long the rover has been standing, and whether it stands at all while its wheels are at rest.

#include <optional>

#include "core/stopping/rover_observation.h"

namespace slipnav {

/// Follows the observations of one standstill.
class Standstill {
 public:
  void observe(const RoverObservation& observation);

  bool isStanding() const { return standing_; }
  /// Accepted in this standstill.
  int zeroUpdates() const { return zero_updates_; }
  /// How long the wheels have been at rest without the filter accepting a standstill [s].
  double unacceptedRest_s() const { return unaccepted_since_ ? toSeconds(newest_ - *unaccepted_since_) : 0.0; }

 private:
  Nanoseconds newest_ = 0;
  bool standing_ = false;
  int zero_updates_ = 0;
  std::optional<Nanoseconds> unaccepted_since_;
};

}  // namespace slipnav
