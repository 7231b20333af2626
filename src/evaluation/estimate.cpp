#include "evaluation/estimate.h"

#include "io/bracket.h"

namespace slipnav {

std::optional<EstimateSample> interpolate(const EstimateTrack& estimates, Nanoseconds stamp, double max_gap_s) {
  const auto bracket = findBracket(estimates, stamp, max_gap_s);
  if (!bracket) {
    return std::nullopt;
  }
  const EstimateSample& from = estimates[bracket->before];
  const EstimateSample& to = estimates[bracket->after];
  const double fraction = bracket->fraction;
  EstimateSample sample = from;
  sample.stamp = stamp;
  sample.position_enu_m = blend(from.position_enu_m, to.position_enu_m, fraction);
  sample.covariance_enu_m2 = blend(from.covariance_enu_m2, to.covariance_enu_m2, fraction);
  sample.q_flu_to_enu = from.q_flu_to_enu.slerp(fraction, to.q_flu_to_enu);
  sample.speed_mps = blend(from.speed_mps, to.speed_mps, fraction);
  return sample;
}

}  // namespace slipnav
