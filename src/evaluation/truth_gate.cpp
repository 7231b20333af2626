#include "evaluation/truth_gate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/base/statistics.h"
#include "io/fields.h"
#include "slipnav/core/earth/planet.h"

namespace slipnav {
namespace {

constexpr std::size_t kSide = 2;  // neighbors on either side
constexpr double kLeastJump_m = 1.0;
constexpr double kLargestSigmas = 3.0;
constexpr double kLargestDeviations = 8.0;
constexpr double kSigmaPerMad = 1.4826;  // of a Gaussian distribution
constexpr double kAtEnds = 0.25;         // rows at either end are not in the middle of the five: less can be said

/// Distance of a row from the median of its neighborhood [m].
double deviation(const std::vector<TruthSample>& samples, std::size_t at) {
  const std::size_t begin = std::min(at - std::min(at, kSide), samples.size() - (2 * kSide + 1));
  Vector3 difference;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t i = begin; i <= begin + 2 * kSide; ++i) {
      values.push_back(samples[i].position_enu_m(axis));
    }
    difference(axis) = samples[at].position_enu_m(axis) - median(values);
  }
  return (at == begin + kSide ? 1.0 : kAtEnds) * difference.norm();
}

}  // namespace

TruthTrack withoutJumps(const TruthTrack& truth) {
  const std::vector<TruthSample>& samples = truth.samples();
  if (samples.size() < 2 * kSide + 1) {
    return truth;
  }
  std::vector<double> deviations;
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    deviations.push_back(deviation(samples, i));
    sigmas.push_back(std::sqrt(std::max(samples[i].covariance_enu_m2.trace(), 0.0)));
  }
  const double limit_m =
      std::max({kLeastJump_m, kLargestSigmas * median(sigmas), kLargestDeviations * kSigmaPerMad * median(deviations)});
  std::vector<TruthSample> kept;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (deviations[i] <= limit_m) {
      kept.push_back(samples[i]);
    }
  }
  return TruthTrack(std::move(kept), truth.maxGap());
}

std::set<Nanoseconds> stampsWithoutJumps(const std::vector<GnssFix>& fixes) {
  std::set<Nanoseconds> stamps;
  if (fixes.empty()) {
    return stamps;
  }
  const GnssFix& first = fixes.front();
  const LocalFrame frame(Planet::byName("earth"),
                         {degToRad(first.latitude_deg), degToRad(first.longitude_deg), first.height_m});
  const TruthTrack truth = withoutJumps(TruthTrack::fromFixes(fixes, frame));
  for (const TruthSample& sample : truth.samples()) {
    stamps.insert(sample.stamp);
  }
  return stamps;
}

void requireTimeInCommon(const TruthTrack& truth, const EstimateTrack& estimates) {
  const Nanoseconds truth_begin = truth.samples().front().stamp;
  const Nanoseconds truth_end = truth.samples().back().stamp;
  if (truth_end < estimates.front().stamp || truth_begin > estimates.back().stamp) {
    throw std::invalid_argument("truth and recording have no time in common: truth is from " +
                                formatSeconds(truth_begin) + " s to " + formatSeconds(truth_end) +
                                " s, the estimate from " + formatSeconds(estimates.front().stamp) + " s to " +
                                formatSeconds(estimates.back().stamp) + " s");
  }
}

}  // namespace slipnav
