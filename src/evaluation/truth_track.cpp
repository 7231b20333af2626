#include "evaluation/truth_track.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/bracket.h"

namespace slipnav {

TruthTrack::TruthTrack(std::vector<TruthSample> samples, double max_gap_s)
    : samples_(std::move(samples)), max_gap_s_(max_gap_s) {
  if (!(max_gap_s > 0.0)) {
    throw std::invalid_argument("truth: max_gap_s must be positive, not " + std::to_string(max_gap_s));
  }
  for (const TruthSample& sample : samples_) {
    if (!sample.position_enu_m.allFinite()) {
      throw std::invalid_argument("truth: position at stamp " + std::to_string(sample.stamp) + " ns is not finite");
    }
  }
  std::stable_sort(samples_.begin(), samples_.end(),
                   [](const TruthSample& a, const TruthSample& b) { return a.stamp < b.stamp; });
  const auto repeated = std::unique(samples_.begin(), samples_.end(),
                                    [](const TruthSample& a, const TruthSample& b) { return a.stamp == b.stamp; });
  samples_.erase(repeated, samples_.end());
}

TruthTrack TruthTrack::fromFixes(const std::vector<GnssFix>& fixes, const LocalFrame& frame, double max_gap_s) {
  std::vector<TruthSample> samples;
  samples.reserve(fixes.size());
  for (const GnssFix& fix : fixes) {
    const Geodetic position{degToRad(fix.latitude_deg), degToRad(fix.longitude_deg), fix.height_m};
    const Matrix3 C_n_to_enu = frame.C_n_to_enu(position);
    TruthSample sample;
    sample.stamp = fix.stamp;
    sample.position_enu_m = frame.toEnu(position);
    sample.covariance_enu_m2 = C_n_to_enu * fix.covariance_ned_m2 * C_n_to_enu.transpose();
    samples.push_back(sample);
  }
  return TruthTrack(std::move(samples), max_gap_s);
}

std::optional<TruthSample> TruthTrack::at(Nanoseconds stamp) const {
  const auto bracket = findBracket(samples_, stamp, max_gap_s_);
  if (!bracket) {
    return std::nullopt;
  }
  const TruthSample& from = samples_[bracket->before];
  const TruthSample& to = samples_[bracket->after];
  TruthSample sample;
  sample.stamp = stamp;
  sample.position_enu_m = blend(from.position_enu_m, to.position_enu_m, bracket->fraction);
  sample.covariance_enu_m2 = blend(from.covariance_enu_m2, to.covariance_enu_m2, bracket->fraction);
  if (from.q_flu_to_enu && to.q_flu_to_enu) {
    sample.q_flu_to_enu = from.q_flu_to_enu->slerp(bracket->fraction, *to.q_flu_to_enu);
  }
  return sample;
}

}  // namespace slipnav
