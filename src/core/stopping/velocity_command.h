#pragma once
/// What an operator asks of the rover, and the command it gets.

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Velocity of the vehicle, in whatever axes the command is given: it is only ever scaled down.
struct VelocityCommand {
  Vector3 linear_mps = Vector3::Zero();
  Vector3 angular_radps = Vector3::Zero();

  bool isFinite() const { return linear_mps.allFinite() && angular_radps.allFinite(); }
  bool isZero() const { return linear_mps.isZero(0.0) && angular_radps.isZero(0.0); }
};

}  // namespace slipnav
