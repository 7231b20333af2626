#include "slipnav/filter/unseen_motion.h"

#include <algorithm>

namespace slipnav {
namespace {

constexpr double kSettling_s = 3.0;
/// Nothing is linear beyond.
constexpr double kLargestTurn_rad = 10.0 * kPi / 180.0;

double square(double x) { return x * x; }

}  // namespace

void UnseenMotion::begin(const NavigationState& state, double gap_s, ErrorCovariance& P) {
  const double turn = degToRad(params_.gap_rate_std_deg_per_s) * gap_s;
  const double tilt = std::min(turn, degToRad(params_.gap_max_tilt_deg));
  const double speed = params_.gap_accel_std_mps2 * gap_s;
  P.diagonal().segment<2>(kAttitude).array() += square(tilt);
  P(kAttitude + 2, kAttitude + 2) += square(turn);
  P.diagonal().segment<3>(kVelocity).array() += square(speed);
  P.diagonal().segment<3>(kPosition).array() += square(0.5 * speed * gap_s);
  turn_variance_ += square(std::min(turn, kLargestTurn_rad));
  end_of_gap_ = state;
}

void UnseenMotion::settle(const NavigationState& state, ErrorCovariance& P) {
  if (turn_variance_ == 0.0 || toSeconds(state.stamp - end_of_gap_.stamp) < kSettling_s) {
    return;
  }
  const Vector3 down = Vector3::UnitZ();
  ErrorVector direction = ErrorVector::Zero();
  direction.segment<3>(kAttitude) = down;
  direction.segment<3>(kVelocity) = down.cross(state.v_eb_n);
  direction.segment<3>(kPosition) = down.cross(positionDifference(planet_, state.position, end_of_gap_.position));
  P += turn_variance_ * direction * direction.transpose();
  turn_variance_ = 0.0;
}

}  // namespace slipnav
