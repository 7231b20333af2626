#pragma once
/// Output of an estimator run for its evaluation.

#include <optional>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// One estimator epoch, in the axes that users see: east-north-up about the start, body forward-left-up (FLU).
struct EstimateSample {
  Nanoseconds stamp = 0;
  Vector3 position_enu_m = Vector3::Zero();
  Matrix3 covariance_enu_m2 = Matrix3::Zero();  ///< of the position
  Quaternion q_flu_to_enu = Quaternion::Identity();
  double speed_mps = 0.0;      ///< forward speed
  std::optional<double> slip;  ///< mean slip ratio of the wheels, none if undefined
  bool stationary = false;     ///< considered at standstill
};

/// Epochs in ascending order of stamp.
using EstimateTrack = std::vector<EstimateSample>;

/// Estimate at `stamp`: position, covariance and speed linear, attitude by slerp, flags and slip of the earlier epoch.
/// None outside the track and inside gaps longer than `max_gap_s`.
std::optional<EstimateSample> interpolate(const EstimateTrack& estimates, Nanoseconds stamp, double max_gap_s);

}  // namespace slipnav
