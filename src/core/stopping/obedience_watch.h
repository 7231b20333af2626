#pragma once
/// Whether a rover that is told to stop actually does.

#include <optional>

#include "core/stopping/rover_observation.h"

namespace slipnav {

/// Compares the commanded speed with the estimate, as long as the rover is told to slow down.
class ObedienceWatch {
 public:
  /// @param told_mps the commanded speed, magnitude; nothing while it is not being stopped
  void observe(std::optional<double> told_mps, const RoverObservation& observation);

  /// It has been clearly faster than commanded for longer than any rover needs to follow.
  bool isIgnored() const { return ignored_; }

 private:
  std::optional<Nanoseconds> faster_since_;
  bool ignored_ = false;
};

}  // namespace slipnav
