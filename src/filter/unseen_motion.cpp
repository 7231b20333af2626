#include "slipnav/filter/unseen_motion.h"

#include <algorithm>

namespace slipnav {
namespace {

constexpr double kSettling_s = 10.0;

double square(double x) { return x * x; }

}  // namespace

void UnseenMotion::begin(const NavigationState& state, double gap_s, ErrorCovariance& P) {
  const double turn = degToRad(params_.gap_rate_std_deg_per_s) * gap_s;
  const double speed = params_.gap_accel_std_mps2 * gap_s;
  tilt_variance_ = square(std::min(turn, degToRad(params_.gap_max_tilt_deg)));
  speed_variance_ = square(speed);
  P(kAttitude + 2, kAttitude + 2) += square(turn);
  P.diagonal().segment<3>(kPosition).array() += square(0.5 * speed * gap_s);
  settled_at_ = state.stamp + fromSeconds(kSettling_s);
  widen(P);
}

void UnseenMotion::doubt(Nanoseconds stamp, ErrorCovariance& P) {
  if (stamp < settled_at_) {
    settled_at_ = stamp + fromSeconds(kSettling_s);
    widen(P);
  }
}

void UnseenMotion::widen(ErrorCovariance& P) const {
  P.diagonal().segment<2>(kAttitude).array() += tilt_variance_;
  P.diagonal().segment<3>(kVelocity).array() += speed_variance_;
}

}  // namespace slipnav
