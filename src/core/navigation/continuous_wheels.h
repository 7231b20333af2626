#pragma once
/// Wheel samples in the continuous time of the IMU, whose steps are told by the mechanisation.

#include <deque>
#include <utility>
#include <vector>

#include "core/ordering/continuous_time.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// A step of the clock and the samples after it come on two ways, so either may be first.
class ContinuousWheels {
 public:
  /// Samples whose time is known now: the one given, or none while a step of the clock is still to be told.
  std::vector<WheelMotion> push(const WheelMotion& wheels);

  /// What the mechanisation knows of the clock. @return the samples whose time is known by it
  std::vector<WheelMotion> learn(const ContinuousTime& time);

  /// The mechanisation has begun again: steps before are no longer counted.
  void recount();

  const ContinuousTime& time() const { return time_; }

 private:
  std::vector<WheelMotion> takeKnown();

  struct Waiting {
    WheelMotion wheels;
    std::size_t steps;
  };

  ContinuousTime time_;
  StepCount count_;
  std::deque<Waiting> waiting_;
};

}  // namespace slipnav
