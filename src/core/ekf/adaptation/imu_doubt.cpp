#include "slipnav/core/ekf/adaptation/imu_doubt.h"

#include <algorithm>
#include <cmath>

#include "core/base/square.h"

namespace slipnav {
namespace {

/// Ten innovations that agree with their predecessors make a factor of e² on the density.
constexpr double kGain = 0.3;
/// With the right Q and R the products scatter about zero by 1: subtracting this keeps their sum from drifting.
constexpr double kTowardsDataSheet = 0.3;
/// A pair of outliers counts no more than two standard deviations.
constexpr double kLargestProduct = 2.0;
constexpr double kLargestTheta = 9.0;
/// Cosine beyond which two directions count as one.
constexpr double kSameDirection = 0.8;

}  // namespace

ImuDoubt::ImuDoubt(double factor_std) : learns_(factor_std > 1.0), theta_(2.0 * std::log(factor_std)) {
  before_.fill(Vector3::Zero());
}

void ImuDoubt::compare(ConstraintAxis axis, double normalized, const Vector3& direction_n) {
  if (!learns_) {
    return;
  }
  Vector3& before = before_[axis];
  const Vector3 now = normalized * direction_n;
  const double product = std::clamp(now.dot(before), -kLargestProduct, kLargestProduct);
  before = now;
  theta_ = std::clamp(theta_ + kGain * (product - kTowardsDataSheet), 0.0, kLargestTheta);
}

double ImuDoubt::excess() const { return std::expm1(theta_); }

double SuccessiveDifference::squared(double innovation, const Vector3& direction_n) {
  const double along = direction_n.dot(before_);
  const bool same = std::abs(along) >= kSameDirection * before_.norm() && along != 0.0;
  before_ = innovation * direction_n;
  return same ? 0.5 * square(innovation - along) : -1.0;
}

}  // namespace slipnav
