#include "slipnav/core/ekf/engine/imu_gap_uncertainty.h"

#include <algorithm>

#include "core/base/square.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

constexpr double kSettling_s = 10.0;
constexpr int kAgreements = 10;  // typically a second of standstill
constexpr double kFaster = 2.0;  // than ever before

}  // namespace

void ImuGapUncertainty::begin(const NavigationState& state, double gap_s, double fastest_mps, ErrorCovariance& P) {
  const double turn = degToRad(params_.gap_rate_std_deg_per_s) * gap_s;
  const double accel = params_.gap_accel_std_mps2;
  const double limit = kFaster * fastest_mps;
  const double speeding_up_s = fastest_mps > 0.0 && accel * gap_s > limit ? limit / accel : gap_s;
  const double speed = accel * speeding_up_s;
  const double way = speed * (gap_s - 0.5 * speeding_up_s);
  doubt_.tilt_variance = square(std::min(turn, degToRad(params_.gap_max_tilt_deg)));
  doubt_.speed_variance = square(speed);
  P(kAttitude + 2, kAttitude + 2) += square(turn);
  P.diagonal().segment<3>(kPosition).array() += square(way);
  doubt_.by_wheels_until = state.stamp + fromSeconds(kSettling_s);
  doubt_.agreements = 0;
  widen(P);
}

void ImuGapUncertainty::allowForStandstill(const NavigationState& before, const NavigationState& after,
                                           ErrorCovariance& P) {
  const double duration_s = toSeconds(after.stamp - before.stamp);
  const Vector3 way_n = 0.5 * duration_s * (before.v_eb_n + after.v_eb_n);
  const double turn = rotationVectorFromQuaternion(after.q_b_to_n * before.q_b_to_n.conjugate()).z();
  P.block<3, 3>(kPosition, kPosition) += way_n * way_n.transpose();
  P(kAttitude + 2, kAttitude + 2) += square(turn);
}

void ImuGapUncertainty::doubt(Nanoseconds stamp, ErrorCovariance& P) {
  if (stamp < doubt_.by_wheels_until) {
    doubt_.by_wheels_until = stamp + fromSeconds(kSettling_s);
    widen(P);
  }
}

void ImuGapUncertainty::standstill(bool agrees, ErrorCovariance& P) {
  doubt_.agreements = agrees ? doubt_.agreements + 1 : 0;
  if (doubt_.agreements >= kAgreements) {
    reset();
  } else if (!agrees) {
    widen(P);
  }
}

void ImuGapUncertainty::widen(ErrorCovariance& P) const {
  P.diagonal().segment<2>(kAttitude).array() += doubt_.tilt_variance;
  P.diagonal().segment<3>(kVelocity).array() += doubt_.speed_variance;
}

}  // namespace slipnav
