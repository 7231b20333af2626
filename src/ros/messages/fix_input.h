#pragma once
/// Satellite positions from messages to a filter that uses them while driving.

#include <sensor_msgs/NavSatFix.h>

#include <deque>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/ordering/continuous_time.h"
#include "core/ordering/jump_filter.h"
#include "slipnav/core/ekf/models/gnss_fix.h"

namespace slipnav {

/// Rejects invalid fixes and single wrong stamps, and keeps the newest: the start becomes known later than they arrive.
class FixInput {
 public:
  explicit FixInput(const Config& config);

  /// @param time of the IMU, whose clock may have been set back
  /// @return the fixes that may be used now, in continuous time; usually one
  std::vector<PositionFix> take(const sensor_msgs::NavSatFix& message, const ContinuousTime& time);

  /// What was wrong with the last message, otherwise "".
  const std::string& problem() const { return problem_; }

  /// Those needed by a filter that starts at `stamp`. Empty if all are from another time.
  std::vector<PositionFix> after(Nanoseconds stamp) const;

  /// IMU stamp from which a filter that knows the fixes until `known` no longer waits for more.
  Nanoseconds decidedAt(Nanoseconds known) const;

 private:
  void keep(const PositionFix& fix);

  std::string topic_;
  Nanoseconds stamp_offset_;
  Nanoseconds max_wait_;
  JumpFilter<PositionFix> jumps_{kFixJump};
  StepCount steps_;
  std::deque<PositionFix> newest_;
  std::string problem_;
};

}  // namespace slipnav
