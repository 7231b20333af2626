#include "overlay/truth_follower.h"

#include <utility>

#include "evaluation/alignment.h"

namespace slipnav {
namespace {

/// Truth that waits longer than this many samples for its estimate is dropped.
constexpr std::size_t kMostWaiting = 5000;
/// Pairs for the heading are taken this far apart.
constexpr double kHeadingPairSpacing_m = 0.1;

TruthTrack trackOf(std::vector<TruthSample> samples) { return TruthTrack(std::move(samples)); }

}  // namespace

TruthFollower::TruthFollower(const TruthParams& params, const Vector3& lever_flu_m)
    : params_(params), lever_flu_m_(lever_flu_m) {}

void TruthFollower::clear() {
  const TruthParams params = params_;
  *this = TruthFollower(params, lever_flu_m_);
}

void TruthFollower::start(const LocalFrame& frame, Nanoseconds stamp) {
  frame_ = frame;
  start_ = stamp;
  anchor_.reset();
  heading_pairs_.clear();
  heading_distance_m_ = 0.0;
  heading_offset_rad_.reset();
}

Nanoseconds TruthFollower::stampOf(const Waiting& truth) {
  return std::visit([](const auto& sample) { return sample.stamp; }, truth);
}

bool TruthFollower::prefers(TruthSource source, Nanoseconds stamp) {
  if (source_ && *source_ < source) {
    return false;
  }
  const bool better = source_ && source < *source_;
  if (better || stamp <= newest_ - kRestartBackstep) {
    waiting_.clear();
    anchor_.reset();
  }
  source_ = source;
  newest_ = stamp;
  return true;
}

void TruthFollower::push(const Waiting& truth) {
  waiting_.push_back(truth);
  if (waiting_.size() > kMostWaiting) {
    waiting_.pop_front();
  }
}

void TruthFollower::add(const GnssFix& fix) {
  if (prefers(TruthSource::kFix, fix.stamp)) {
    GnssFix shifted = fix;
    shifted.stamp += fromSeconds(params_.stamp_offset_s);
    push(shifted);
  }
}

void TruthFollower::add(TruthSource source, const TruthSample& pose) {
  if (prefers(source, pose.stamp)) {
    TruthSample shifted = pose;
    shifted.stamp += fromSeconds(params_.stamp_offset_s);
    push(shifted);
  }
}

TruthSample TruthFollower::inMap(const Waiting& truth) const {
  if (const auto* fix = std::get_if<GnssFix>(&truth)) {
    return TruthTrack::fromFixes({*fix}, *frame_).samples().front();
  }
  return std::get<TruthSample>(truth);
}

std::vector<TruthPair> TruthFollower::follow(const EstimateSample& earlier, const EstimateSample& later) {
  std::vector<TruthPair> placed;
  if (!frame_) {
    return placed;
  }
  while (!waiting_.empty() && stampOf(waiting_.front()) <= later.stamp) {
    const Waiting truth = waiting_.front();
    waiting_.pop_front();
    const auto estimate = interpolate({earlier, later}, stampOf(truth), TruthTrack::kMaxGapS);
    if (estimate && estimate->stamp >= start_) {
      place({inMap(truth), *estimate}, placed);
    }
  }
  return placed;
}

void TruthFollower::place(const TruthPair& pair, std::vector<TruthPair>& placed) {
  if (!anchor_) {
    anchor_ = pair;
  }
  const TruthAlignment alignment = params_.alignment(source_ == TruthSource::kFix);
  if (alignment.heading_distance_m && !heading_offset_rad_) {
    collectHeading(pair, placed);
  } else {
    placed.push_back(aligned(pair));
  }
}

TruthPair TruthFollower::aligned(const TruthPair& pair) const {
  const TruthAlignment alignment = params_.alignment(source_ == TruthSource::kFix);
  const EstimateTrack estimates = {pair.estimate};
  TruthTrack truth = trackOf({pair.truth});
  if (alignment.at_start) {
    const TruthTrack both = trackOf({anchor_->truth, pair.truth});
    truth = trackOf({alignAtStart(both, {anchor_->estimate}, *alignment.at_start).samples().back()});
  }
  if (!lever_flu_m_.isZero()) {
    truth = removeLeverArm(truth, estimates, lever_flu_m_);
  }
  TruthSample sample = truth.samples().front();
  if (alignment.heading_distance_m) {
    const Eigen::AngleAxisd turn(*heading_offset_rad_, Vector3::UnitZ());
    sample.position_enu_m =
        anchor_->estimate.position_enu_m + turn * (sample.position_enu_m - anchor_->estimate.position_enu_m);
  }
  return {sample, pair.estimate};
}

void TruthFollower::collectHeading(const TruthPair& pair, std::vector<TruthPair>& placed) {
  if (!heading_pairs_.empty()) {
    const double step_m =
        (pair.estimate.position_enu_m - heading_pairs_.back().estimate.position_enu_m).head<2>().norm();
    if (step_m < kHeadingPairSpacing_m) {
      return;
    }
    heading_distance_m_ += step_m;
  }
  heading_pairs_.push_back(pair);
  if (heading_distance_m_ < params_.heading_distance_m) {
    return;
  }
  EstimateTrack estimates;
  std::vector<TruthSample> truth;
  for (const TruthPair& collected : heading_pairs_) {
    estimates.push_back(collected.estimate);
    truth.push_back(collected.truth);
  }
  heading_offset_rad_ = headingOffset(trackOf(truth), estimates, heading_distance_m_);
  for (const TruthPair& collected : heading_pairs_) {
    placed.push_back(aligned(collected));
  }
  heading_pairs_.clear();
}

}  // namespace slipnav
