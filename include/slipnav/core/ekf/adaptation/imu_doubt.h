#pragma once
/// How much noisier an IMU is in motion than its data sheet and its own samples indicate.
///
/// A bias that shifts under vibration, scale and cross-axis errors of a turning gyro, a slow drift of its
/// rate: none shows in the samples, all move the velocity for seconds. They show in the innovations of what a
/// wheeled vehicle cannot do, move sideways or off the ground: if Q is too small each innovation resembles the
/// previous one, if R is too small each differs (R. K. Mehra, On the identification of variances and adaptive Kalman
/// filtering, IEEE TAC 15(2), 1970). A velocity error is fixed in the navigation frame, so innovations along
/// different directions are compared through their common component.

#include <array>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Measured velocities whose innovations are compared, each with its predecessor.
enum ConstraintAxis : int { kSideways = 0, kOffGround, kConstraintAxes };

/// θ, the logarithm of a factor on the densities of accelerometers and gyros. Each innovation moves it by the product
/// with its predecessor, r_k·r_{k-1}/√(S_k S_{k-1}), whose mean is zero when Q and R are right, and by a small step
/// towards 1.
class ImuDoubt {
 public:
  /// @param factor_std initial factor on the standard deviations; 1: the data sheet is exact and stays so
  explicit ImuDoubt(double factor_std);

  /// The innovation is r/√S before the update. @param direction_n unit vector along which the velocity was measured
  void compare(ConstraintAxis axis, double normalized, const Vector3& direction_n);

  /// Density beyond the known one, relative to it; 0 or more.
  double excess() const;

 private:
  bool learns_;
  double theta_;
  std::array<Vector3, kConstraintAxes> before_;
};

/// What an innovation says about R: half the squared difference to its predecessor, which has the variance R, while
/// longer-lasting state errors cancel.
class SuccessiveDifference {
 public:
  /// @return in the units of the innovation squared; negative when the previous one was along another direction
  double squared(double innovation, const Vector3& direction_n);

 private:
  Vector3 before_ = Vector3::Zero();
};

}  // namespace slipnav
