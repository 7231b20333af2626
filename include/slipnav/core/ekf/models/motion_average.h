#pragma once
/// Mean predicted motion over a wheel interval, whose ends need not fall on IMU stamps (Groves 16.3: residuals are
/// averaged over the odometry interval).

#include <optional>

#include "slipnav/core/ekf/models/body_motion.h"
#include "slipnav/core/ins/ins_engine.h"

namespace slipnav {

/// Integral of the motion over the open interval.
class MotionAverage {
 public:
  /// Starts an interval at `start`; 0: no interval is open.
  void restart(Nanoseconds start);
  Nanoseconds start() const { return start_; }

  /// Adds the part of a step that lies in [from, to], with the step's mean motion.
  /// @param v_eb_b mean velocity of the reference point over the step, body axes
  /// @return length of that part [s]
  double add(const InsStep& step, const Vector3& v_eb_b, Nanoseconds from, Nanoseconds to);

  /// Corrects what was added: the integral of the velocity changes by `travel_b` [m].
  void addTravel(const Vector3& travel_b) { integral_.v_eb_b += travel_b; }

  /// Mean over what was added; nothing if that is empty.
  std::optional<BodyMotion> mean() const;

 private:
  Nanoseconds start_ = 0;
  BodyMotion integral_;
};

}  // namespace slipnav
