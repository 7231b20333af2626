#pragma once
/// The wheels of the two sides compared with each other and with the turn rate.

#include <optional>
#include <vector>

#include "calibration/calibration.h"

namespace slipnav {

/// A wheel nearer to the middle belongs to neither side.
inline constexpr double kLeastSideOffset_m = 1e-3;

/// Mean speed and position of the wheels of each side, by configured radii.
class Sides {
 public:
  /// @param wheels must outlive this
  explicit Sides(const std::vector<WheelParams>& wheels) : wheels_(wheels) {
    for (const WheelParams& wheel : wheels) {
      left_ += wheel.y_m > kLeastSideOffset_m ? 1.0 : 0.0;
      right_ += wheel.y_m < -kLeastSideOffset_m ? 1.0 : 0.0;
      left_y_m_ += std::max(wheel.y_m, 0.0);
      right_y_m_ -= std::min(wheel.y_m, 0.0);
    }
    left_y_m_ /= std::max(left_, 1.0);
    right_y_m_ /= std::max(right_, 1.0);
  }

  bool present(const WheelMotion& wheels) const {
    return wheels.count == wheels_.size() && left_ > 0.0 && right_ > 0.0;
  }
  double track() const { return left_y_m_ + right_y_m_; }
  double leftOffset() const { return left_y_m_; }
  double rightOffset() const { return right_y_m_; }

  double leftSpeed(const WheelMotion& wheels) const { return sum(wheels, 1.0) / left_; }
  double rightSpeed(const WheelMotion& wheels) const { return sum(wheels, -1.0) / right_; }

 private:
  double sum(const WheelMotion& wheels, double side) const {
    double sum_mps = 0.0;
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      sum_mps += side * wheels_[i].y_m > kLeastSideOffset_m ? wheels.circumferential_mps[i] : 0.0;
    }
    return sum_mps;
  }

  const std::vector<WheelParams>& wheels_;
  double left_ = 0.0;
  double right_ = 0.0;
  double left_y_m_ = 0.0;   ///< mean offset of the left wheels, positive
  double right_y_m_ = 0.0;  ///< of the right wheels, positive
};

/// Relation of the two sides, slip included.
struct SideFit {
  double half_difference = 0.0;  ///< (left − right) / (left + right) of the radius ratios
  double half_difference_std = 0.0;
  std::optional<Calibrated> turn_gain;  ///< scrub factor over mean radius ratio
};

/// Least squares of the difference of the sides on their sum and on the turn rate over the whole drive.
/// @param with_scrub the drive has turns; otherwise the scrub factor is taken as `assumed_scrub`
SideFit fitSides(const Sides& sides, double batch_m, double assumed_scrub, bool with_scrub,
                 const std::vector<MotionSample>& samples);

/// The stretch of the drive that a sample belongs to.
std::size_t batchOf(const MotionSample& sample, double batch_m);

}  // namespace slipnav
