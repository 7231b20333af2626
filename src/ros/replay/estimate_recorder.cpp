#include "ros/replay/estimate_recorder.h"

#include <cmath>

#include "ros/messages/conversions.h"

namespace slipnav {

template <class Value>
void EstimateRecorder::Stream<Value>::insert(Nanoseconds stamp, const Value& value) {
  const Nanoseconds continuous = time.add(stamp);
  if (!values.empty() && continuous <= values.rbegin()->first - kRestartBackstep) {
    values.clear();
  }
  values[continuous] = value;
}

void EstimateRecorder::add(const nav_msgs::Odometry& message) {
  const EstimateSample sample = toEstimateSample(message);
  estimates_.insert(sample.stamp, sample);
}

void EstimateRecorder::add(const NavState& message) {
  stationary_.insert(toNanoseconds(message.header.stamp), message.status == NavState::STATUS_STATIONARY);
}

void EstimateRecorder::add(const Slip& message) {
  slip_.insert(toNanoseconds(message.header.stamp), message.mean_ratio);
}

EstimateTrack EstimateRecorder::track() const {
  EstimateTrack track;
  track.reserve(estimates_.values.size());
  for (const auto& [stamp, estimate] : estimates_.values) {
    track.push_back(estimate);
    track.back().stamp = stamp;
    const auto stationary = stationary_.values.find(stamp);
    track.back().stationary = stationary != stationary_.values.end() && stationary->second;
    const auto after = slip_.values.upper_bound(stamp);
    if (after != slip_.values.begin() && !std::isnan(std::prev(after)->second)) {
      track.back().slip = std::prev(after)->second;
    }
  }
  return track;
}

}  // namespace slipnav
