#pragma once
/// What an IMU measured between two of its samples.

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Mean specific force and angular rate over an interval of known length, biases included.
struct ImuInterval {
  Vector3 f_ib_b = Vector3::Zero();      ///< [m/s²]
  Vector3 omega_ib_b = Vector3::Zero();  ///< [rad/s]
  double duration_s = 0.0;               ///< 0: there is no such interval
};

}  // namespace slipnav
