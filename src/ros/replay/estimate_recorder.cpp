#include "ros/replay/estimate_recorder.h"

#include <cmath>

#include "ros/messages/conversions.h"

namespace slipnav {

template <class Value>
void EstimateRecorder::insert(Nanoseconds stamp, const Value& value, std::map<Nanoseconds, Value>& values) {
  if (!values.empty() && stamp <= values.rbegin()->first - kRestartBackstep) {
    values.clear();
  }
  values[stamp] = value;
}

void EstimateRecorder::add(const nav_msgs::Odometry& message) {
  const EstimateSample sample = toEstimateSample(message);
  insert(sample.stamp, sample, estimates_);
}

void EstimateRecorder::add(const NavState& message) {
  insert(toNanoseconds(message.header.stamp), message.status == NavState::STATUS_STATIONARY, stationary_);
}

void EstimateRecorder::add(const Slip& message) {
  insert(toNanoseconds(message.header.stamp), message.mean_ratio, slip_);
}

EstimateTrack EstimateRecorder::track() const {
  EstimateTrack track;
  track.reserve(estimates_.size());
  for (const auto& [stamp, estimate] : estimates_) {
    track.push_back(estimate);
    const auto stationary = stationary_.find(stamp);
    track.back().stationary = stationary != stationary_.end() && stationary->second;
    const auto after = slip_.upper_bound(stamp);
    if (after != slip_.begin() && !std::isnan(std::prev(after)->second)) {
      track.back().slip = std::prev(after)->second;
    }
  }
  return track;
}

}  // namespace slipnav
