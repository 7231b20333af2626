#include "inspection/imu_track.h"

#include <algorithm>

#include "inspection/stream_check.h"
#include "slipnav/core/sensors/imu_screen.h"

namespace slipnav {

ImuTrack::ImuTrack(const ImuRecord& record, Nanoseconds origin) {
  const std::vector<double> times_s = continuousTimes(timesOf(record), origin);
  ImuClock clock(ImuInputParams{}.gap_factor);
  for (std::size_t i = 0; i < record.samples.size(); ++i) {
    const RawImuSample& sample = record.samples[i];
    if (sample.specific_force.allFinite() && sample.angular_rate.allFinite()) {
      clock.push({fromSeconds(times_s[i]), sample.specific_force, sample.angular_rate});
    }
    while (const std::optional<ImuSample> corrected = clock.pop()) {
      add(*corrected);
    }
    faults_.scatter_s = std::max(faults_.scatter_s, clock.faults().scatters() ? clock.faults().scatter_s : 0.0);
  }
  faults_.usual_interval_s = clock.faults().usual_interval_s;
  faults_.equal = clock.faults().equal;
  faults_.lost = clock.faults().lost;
}

void ImuTrack::add(const ImuSample& sample) {
  const double time_s = toSeconds(sample.stamp);
  if (!time_s_.empty() && time_s <= time_s_.back()) {
    return;
  }
  time_s_.push_back(time_s);
  force_.push_back(sample.f_ib_b);
  rate_.push_back(sample.omega_ib_b);
  force_sum_.push_back(force_sum_.back() + sample.f_ib_b);
  rate_sum_.push_back(rate_sum_.back() + sample.omega_ib_b);
}

std::size_t ImuTrack::firstAfter(double time_s) const {
  return static_cast<std::size_t>(std::upper_bound(time_s_.begin(), time_s_.end(), time_s) - time_s_.begin());
}

Vector3 ImuTrack::mean(const std::vector<Vector3>& sums, double from_s, double to_s) const {
  const std::size_t begin = firstAfter(from_s);
  const std::size_t end = firstAfter(to_s);
  return end > begin ? Vector3((sums[end] - sums[begin]) / static_cast<double>(end - begin)) : Vector3::Zero();
}

}  // namespace slipnav
