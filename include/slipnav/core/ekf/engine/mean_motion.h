#pragma once
/// Mean predicted motion over an interval during which the estimate is corrected, and how it depends on the
/// error of the estimate at the end.

#include <optional>

#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/models/motion_average.h"

namespace slipnav {

/// A measurement of a mean says something about the current error: δv̄ = (1/T) ∫ H(t) Φ(t, now) dt · δx(now). When δx is
/// corrected, the average so far is corrected with it.
class MeanMotion {
 public:
  /// Starts an interval at `start`; 0: no interval is open.
  void restart(Nanoseconds start);
  Nanoseconds start() const { return average_.start(); }

  /// Propagates the error through a step; call before that step is added.
  void propagate(const ErrorTransition& transition);
  /// Adds the part of a step that lies in [from, to].
  /// @param v_eb_b mean velocity of the reference point over the step, body axes; @param H_v of that velocity
  void add(const InsStep& step, const Vector3& v_eb_b, const VelocityJacobian& H_v, Nanoseconds from, Nanoseconds to);
  /// `error` was removed from the estimate.
  void correct(const ErrorVector& error, const ErrorReset& reset);

  /// Mean over what was added; nothing if that is empty.
  std::optional<BodyMotion> mean() const { return average_.mean(); }
  /// ∂(mean velocity)/∂(error state now); only where there is a mean.
  VelocityJacobian jacobian() const { return integral_ / average_.mean()->duration_s; }

 private:
  MotionAverage average_;
  VelocityJacobian integral_ = VelocityJacobian::Zero();
};

}  // namespace slipnav
