#include "core/forecast/recent_drive.h"

#include <algorithm>
#include <cmath>

#include "core/slip/vehicle_slip.h"

namespace slipnav {
namespace {

/// Below this share of the highest speed the rover is starting or stopping.
constexpr double kCruisingShare = 0.7;

/// What is this close to complete is complete: stamps are not exact.
constexpr double kNearly = 0.5;

/// Samples of a full window.
double samplesOf(const ForecastParams& params) { return std::max(1.0, params.window_s / params.wheel_interval_s); }

}  // namespace

void RecentDrive::retune(const ForecastParams& params, bool all) {
  params_ = params;
  all_ = all;
}

void RecentDrive::reset() { *this = RecentDrive(params_, all_); }

void RecentDrive::add(const Estimate& estimate) {
  const BodyMotion& motion = estimate.motion;
  newest_ = estimate.nav.stamp;
  driven_s_ += motion.duration_s;
  intervals_.push_back({motion.v_eb_b.x(), estimate.wheel_speed_used, estimate.nav.q_b_to_n});
  if (static_cast<double>(intervals_.size()) > samplesOf(params_)) {
    intervals_.pop_front();
  }
  if (all_ || estimate.wheel_speed_used) {
    lengthen(motion, estimate.wheels.motion.forward_mps);
  } else {
    piece_ = Piece{};
  }
}

void RecentDrive::lengthen(const BodyMotion& motion, double wheel_speed_mps) {
  piece_.way_m += motion.v_eb_b.x() * motion.duration_s;
  piece_.wheel_way_m += wheel_speed_mps * motion.duration_s;
  piece_.duration_s += motion.duration_s;
  piece_.intervals += 1.0;
  const double added_m = std::max(std::abs(motion.v_eb_b.x()), std::abs(wheel_speed_mps)) * motion.duration_s;
  const double length_m = std::max(std::abs(piece_.way_m), std::abs(piece_.wheel_way_m));
  if (length_m + kNearly * added_m >= params_.window_m / samplesOf(params_) &&
      piece_.duration_s + kNearly * motion.duration_s >= params_.wheel_interval_s) {
    close(newest_);
  }
}

void RecentDrive::close(Nanoseconds stamp) {
  const std::optional<double> slip = slipRatio(piece_.way_m, piece_.wheel_way_m, 0.0);
  if (slip && std::abs(*slip) < 1.0) {
    slips_.push_back({stamp, *slip, driven_s_, piece_.intervals, std::abs(piece_.wheel_way_m)});
  }
  piece_ = Piece{};
  const auto standing_s = [this] {
    return toSeconds(slips_.back().stamp - slips_.front().stamp) - (slips_.back().driven_s - slips_.front().driven_s);
  };
  while (!slips_.empty() &&
         (static_cast<double>(slips_.size()) > samplesOf(params_) || standing_s() > params_.max_age_s)) {
    slips_.pop_front();
  }
}

SlipSamples RecentDrive::slip() const {
  SlipSamples samples;
  for (const Slip& slip : slips_) {
    samples.times_s.push_back(toSeconds(slip.stamp - origin()));
    samples.slips.push_back(slip.slip);
  }
  return samples;
}

double RecentDrive::intervalsPerSlip() const {
  double sum = 0.0;
  for (const Slip& slip : slips_) {
    sum += slip.intervals;
  }
  return slips_.empty() ? 1.0 : sum / static_cast<double>(slips_.size());
}

std::optional<double> RecentDrive::meanSlip(double way_m, Nanoseconds since) const {
  double sum_m = 0.0;
  double driven_m = 0.0;
  for (auto slip = slips_.rbegin(); slip != slips_.rend() && slip->stamp > since; ++slip) {
    sum_m += slip->way_m * slip->slip;
    driven_m += slip->way_m;
    if (driven_m >= way_m) {
      return sum_m / driven_m;
    }
  }
  return std::nullopt;
}

double RecentDrive::cruisingSpeed() const {
  const auto slower = [](const Interval& a, const Interval& b) {
    return std::abs(a.speed_mps) < std::abs(b.speed_mps);
  };
  const double fastest_mps = std::abs(std::max_element(intervals_.begin(), intervals_.end(), slower)->speed_mps);
  const double most = std::max(1.0, params_.speed_window_s / params_.wheel_interval_s);
  double sum_mps = 0.0;
  double count = 0.0;
  for (auto interval = intervals_.rbegin(); interval != intervals_.rend() && count < most; ++interval) {
    if (std::abs(interval->speed_mps) >= kCruisingShare * fastest_mps) {
      sum_mps += interval->speed_mps;
      count += 1.0;
    }
  }
  return sum_mps / count;
}

double RecentDrive::wheelShare() const {
  double used = 0.0;
  for (const Interval& interval : intervals_) {
    used += interval.wheel_speed_used ? 1.0 : 0.0;
  }
  return used / static_cast<double>(intervals_.size());
}

const Quaternion& RecentDrive::attitude(std::size_t back) const {
  const std::size_t last = intervals_.size() - 1;
  const std::size_t phase = last > 0 ? back % (2 * last) : 0;
  return intervals_[last - std::min(phase, 2 * last - phase)].q_b_to_n;
}

}  // namespace slipnav
