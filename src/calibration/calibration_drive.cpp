#include "calibration/calibration_drive.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "slipnav/core/ordering/imu_clock.h"

namespace slipnav {
namespace {

template <class Sample>
void sortSamples(std::vector<Sample>& samples) {
  std::stable_sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  const auto repeated =
      std::unique(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.stamp == b.stamp; });
  samples.erase(repeated, samples.end());
}

[[noreturn]] void failForGap(double gap_s, double after_s) {
  std::ostringstream message;
  message << "the IMU is silent for " << gap_s << " s, " << after_s
          << " s after its first sample; calibrate on a part of the recording without such a gap";
  throw std::invalid_argument(message.str());
}

std::vector<ImuSample> withCorrectedStamps(const std::vector<ImuSample>& samples, const ImuInputParams& params) {
  ImuClock clock(params.gap_factor);
  std::vector<ImuSample> corrected;
  corrected.reserve(samples.size());
  for (const ImuSample& sample : samples) {
    clock.push(sample);
    while (const std::optional<ImuSample> next = clock.pop()) {
      corrected.push_back(*next);
    }
  }
  return corrected;
}

}  // namespace

void sortByStamp(CalibrationDrive& drive) {
  sortSamples(drive.imu);
  sortSamples(drive.wheels);
  sortSamples(drive.truth);
}

std::vector<TimedInterval> imuIntervals(const std::vector<ImuSample>& samples, const ImuInputParams& params) {
  ImuScreen screen(params);
  std::vector<TimedInterval> intervals;
  intervals.reserve(samples.size());
  Nanoseconds before = 0;
  for (const ImuSample& sample : withCorrectedStamps(samples, params)) {
    const ImuScreen::Result result = screen.check(sample);
    if (!isAccepted(result.verdict)) {
      continue;
    }
    if (result.gap_s > params.max_bridged_gap_s) {
      failForGap(result.gap_s, toSeconds(before - samples.front().stamp));
    }
    if (result.interval.duration_s > 0.0) {
      intervals.push_back({before, sample.stamp, result.interval});
    }
    before = sample.stamp;
  }
  return intervals;
}

}  // namespace slipnav
