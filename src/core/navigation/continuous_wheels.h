#pragma once
/// Wheel samples in the continuous time of the IMU, whose clock steps are reported by the mechanization.

#include <deque>
#include <utility>
#include <vector>

#include "core/ordering/continuous_time.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// A step of the clock and the samples after it arrive by two routes, so either may be first.
class ContinuousWheels {
 public:
  /// Samples whose time is now known: the given one, or none while a step of the clock is still to be reported.
  std::vector<WheelMotion> push(const WheelMotion& wheels);

  /// Takes the mechanization's view of the clock. @return the samples whose time is known from it
  std::vector<WheelMotion> learn(const ContinuousTime& time);

  /// The mechanization has restarted: earlier steps no longer count.
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
