#include "evaluation/stop_ledger.h"

#include <algorithm>

#include "core/base/statistics.h"

namespace slipnav {
namespace {

/// An encoder between two counts flickers; a rover slower than this does not move between stops.
constexpr double kRestSpeed_mps = 0.002;
/// The filter may process the last sample of a rest a moment later.
constexpr double kUpdateDelay_s = 0.5;
constexpr double kQuiet = 0.25;  // of the usual variance while driving

}  // namespace

void StopLedger::Spread::add(const Vector3& rate) {
  count += 1.0;
  sum += rate;
  sum_square += rate.squaredNorm();
}

double StopLedger::Spread::variance() const {
  return count > 0.0 ? std::max((sum_square - sum.squaredNorm() / count) / count, 0.0) : 0.0;
}

StopLedger::StopLedger(const StationaryParams& stationary, const ImuFloor& floor, double gravity_mps2)
    : rest_speed_mps_(std::max(stationary.wheel_speed_mps, kRestSpeed_mps)),
      gravity_mps2_(gravity_mps2),
      detector_(stationary, floor) {}

void StopLedger::add(const ImuSample& sample) {
  if (!sample.f_ib_b.allFinite() || !sample.omega_ib_b.allFinite()) {
    return;
  }
  detector_.addImu(sample.stamp, sample.f_ib_b, sample.omega_ib_b);
  if (open_) {
    open_->rate.add(sample.omega_ib_b);
  } else if (driving_since_ != 0) {
    driving_.add(sample.omega_ib_b);
  }
}

void StopLedger::add(const WheelMotion& wheels) {
  detector_.addWheels(wheels.stamp, wheels.largest_speed_mps);
  const bool detected = detector_.judge(gravity_mps2_);
  if (wheels.largest_speed_mps > rest_speed_mps_) {
    noteMotion(wheels.stamp);
    return;
  }
  if (!open_) {
    open_ = WheelRest{{wheels.stamp, wheels.stamp}, {}, false};
    driving_since_ = 0;
  }
  open_->time.end = wheels.stamp;
  open_->detected = open_->detected || detected;
}

void StopLedger::noteMotion(Nanoseconds stamp) {
  if (open_ && has_moved_ && toSeconds(open_->time.end - open_->time.begin) >= kShortestStop_s) {
    rests_.push_back(*open_);
  }
  open_.reset();
  has_moved_ = true;
  if (driving_since_ != 0 && toSeconds(stamp - driving_since_) >= kShortestStop_s) {
    driving_variances_.push_back(driving_.variance());
    driving_since_ = 0;
  }
  if (driving_since_ == 0) {
    driving_since_ = stamp;
    driving_ = Spread{};
  }
}

bool StopLedger::isStandstill(const WheelRest& rest, double driving_variance) const {
  return rest.detected || rest.rate.variance() <= kQuiet * driving_variance;
}

StopCounts StopLedger::counts(Nanoseconds from, Nanoseconds to) const {
  const double driving_variance = driving_variances_.empty() ? 0.0 : median(driving_variances_);
  StopCounts counts;
  for (const WheelRest& rest : rests_) {
    if (rest.time.begin < from || rest.time.end > to || !isStandstill(rest, driving_variance)) {
      continue;
    }
    ++counts.seen;
    const auto update = std::lower_bound(zero_updates_.begin(), zero_updates_.end(), rest.time.begin);
    const bool used = update != zero_updates_.end() && *update <= rest.time.end + fromSeconds(kUpdateDelay_s);
    counts.used += used ? 1 : 0;
  }
  return counts;
}

}  // namespace slipnav
