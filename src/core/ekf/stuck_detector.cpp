#include "slipnav/core/ekf/stuck_detector.h"

#include <cmath>

namespace slipnav {
namespace {

constexpr double kHolds_s = 1.0;
/// For so long all must hold; then the estimate no longer decides, since spinning wheels pull it along.
constexpr double kSlow_s = 0.5;
/// Of the wheel speed, with two standard deviations of the estimate added.
constexpr double kMostSpeedKept = 1.0 / 3.0;
constexpr double kSigmas = 2.0;

}  // namespace

bool StuckDetector::judge(const SpinEvidence& evidence) {
  const double speed_mps = std::abs(evidence.forward_mps) + kSigmas * evidence.forward_std_mps;
  const bool still = evidence.level_of_rest && evidence.calmer_than_driving;
  const bool was_slow = stuck_ || (since_ != 0 && toSeconds(evidence.stamp - since_) >= kSlow_s);
  if (!still || !(was_slow || speed_mps < kMostSpeedKept * evidence.wheels_mps)) {
    reset();
    return false;
  }
  if (since_ == 0) {
    since_ = evidence.stamp;
  }
  stuck_ = stuck_ || toSeconds(evidence.stamp - since_) >= kHolds_s;
  return stuck_;
}

}  // namespace slipnav
