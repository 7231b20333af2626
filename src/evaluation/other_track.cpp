#include "evaluation/other_track.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "evaluation/alignment.h"

namespace slipnav {
namespace {

constexpr double kAlignment_m = 30.0;

EstimateTrack asEstimates(const TruthTrack& truth) {
  EstimateTrack track;
  track.reserve(truth.samples().size());
  for (const TruthSample& sample : truth.samples()) {
    EstimateSample estimate;
    estimate.stamp = sample.stamp;
    estimate.position_enu_m = sample.position_enu_m;
    track.push_back(estimate);
  }
  return track;
}

TruthTrack within(const std::vector<TumPose>& poses, Nanoseconds begin, Nanoseconds end) {
  std::vector<TruthSample> samples;
  samples.reserve(poses.size());
  for (const TumPose& pose : poses) {
    if (pose.stamp >= begin && pose.stamp <= end) {
      samples.push_back({pose.stamp, pose.position_enu_m, pose.q_flu_to_enu});
    }
  }
  return TruthTrack(std::move(samples));
}

/// Shift that moves `other`, rotated by `turn`, to the reference at the first epoch in common.
Vector3 shiftToReference(const TruthTrack& other, const Quaternion& turn, const EstimateTrack& reference) {
  for (const TruthSample& sample : other.samples()) {
    if (const auto there = interpolate(reference, sample.stamp, other.maxGap())) {
      return there->position_enu_m - turn * sample.position_enu_m;
    }
  }
  throw std::invalid_argument("no epoch in common with the drive");
}

/// Stops and speed are those of the drive.
EstimateTrack moved(const TruthTrack& other, const Quaternion& turn, const Vector3& shift_m,
                    const EstimateTrack& estimates) {
  EstimateTrack track;
  track.reserve(other.samples().size());
  for (const TruthSample& sample : other.samples()) {
    EstimateSample pose = interpolate(estimates, sample.stamp, other.maxGap()).value_or(EstimateSample{});
    pose.stamp = sample.stamp;
    pose.position_enu_m = turn * sample.position_enu_m + shift_m;
    pose.covariance_enu_m2.setZero();
    pose.q_flu_to_enu = turn * sample.q_flu_to_enu.value_or(Quaternion::Identity());
    pose.slip = std::nullopt;
    track.push_back(pose);
  }
  return track;
}

}  // namespace

OtherTrack besideTheEstimate(const std::string& name, const std::vector<TumPose>& poses, const EstimateTrack& estimates,
                             const TruthTrack& truth) {
  try {
    const TruthTrack other = within(poses, estimates.front().stamp, estimates.back().stamp);
    if (other.empty()) {
      throw std::invalid_argument("no pose in the time of the drive; are its stamps those of the recording?");
    }
    const EstimateTrack reference = truth.empty() ? estimates : asEstimates(truth);
    const Quaternion turn(Eigen::AngleAxisd(headingOffset(other, reference, kAlignment_m), Vector3::UnitZ()));
    OtherTrack result;
    result.name = name;
    result.estimates = moved(other, turn, shiftToReference(other, turn, reference), estimates);
    MetricsInput input;
    input.estimates = result.estimates;
    input.truth = truth;
    result.metrics = computeMetrics(input);
    result.metrics.position_nees_mean = result.metrics.coverage_3sigma_pct = std::nullopt;
    return result;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("compare " + name + ": " + error.what());
  }
}

}  // namespace slipnav
