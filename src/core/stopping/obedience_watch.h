#pragma once
/// Whether a rover that is told to stop does.

#include <optional>

#include "core/stopping/rover_observation.h"

namespace slipnav {

/// Compares what the rover is told with what the estimate says, as long as it is told to slow down.
class ObedienceWatch {
 public:
  /// @param told_mps the speed that the rover is told, magnitude; nothing while it is not being stopped
  void observe(std::optional<double> told_mps, const RoverObservation& observation);

  /// It has been driving clearly faster than it is told for as long as no rover needs to follow.
  bool isIgnored() const { return ignored_; }

 private:
  std::optional<Nanoseconds> faster_since_;
  bool ignored_ = false;
};

}  // namespace slipnav
