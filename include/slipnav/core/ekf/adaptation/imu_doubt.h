#pragma once
/// How much noisier an IMU is in motion than its data sheet and its own samples say.
///
/// A bias that shifts when the sensor is shaken, scale and cross-axis errors of a gyro that turns, a slow wander of its
/// rate: none is seen in the samples, all drive the velocity away for seconds. They show in the innovations of what a
/// wheeled vehicle cannot do, to move sideways or off the ground: where Q is too small each innovation is like the one
/// before, where R is, each is different (R. K. Mehra, On the identification of variances and adaptive Kalman
/// filtering, IEEE TAC 15(2), 1970). The velocity that is wrong lies in the navigation frame, so innovations along
/// different directions are compared by what they have in common.

#include <array>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Measured velocities whose innovations are compared, each with the one before.
enum ConstraintAxis : int { kSideways = 0, kOffGround, kConstraintAxes };

/// θ, the logarithm of a factor on the densities of accelerometers and gyros. Each innovation moves it by the product
/// with the one before, r_k·r_{k-1}/√(S_k S_{k-1}), whose mean is zero when Q and R are right, and by a small step
/// towards 1.
class ImuDoubt {
 public:
  /// @param factor_std on the standard deviations, before anything is compared; 1: the data sheet is exact and stays so
  explicit ImuDoubt(double factor_std);

  /// @param normalised r/√S before the update; @param direction_n unit vector that the velocity was measured along
  void compare(ConstraintAxis axis, double normalised, const Vector3& direction_n);

  /// Density beyond the one that is known, relative to it; 0 or more.
  double excess() const;

 private:
  bool learns_;
  double theta_;
  std::array<Vector3, kConstraintAxes> before_;
};

/// What an innovation tells of R: half the squared difference to the one before, which has its variance, while what the
/// state has wrong for longer drops out.
class SuccessiveDifference {
 public:
  /// @return in the units of the innovation squared; negative when the one before was along another direction
  double squared(double innovation, const Vector3& direction_n);

 private:
  Vector3 before_ = Vector3::Zero();
};

}  // namespace slipnav
