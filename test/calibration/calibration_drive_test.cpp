#include "calibration/calibration_drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace slipnav {
namespace {

/// A host that stamps every fourth sample late: the intervals are those of the sensor.
TEST(ImuIntervals, AreEvenWhereStampsScatter) {
  constexpr int kSamples = 3000;
  constexpr int kSettled = 100;
  constexpr double kPeriod_s = 0.01;
  std::vector<ImuSample> samples;
  for (int i = 0; i < kSamples; ++i) {
    ImuSample sample;
    sample.stamp = 1'600'000'000 * kSecond + fromSeconds(kPeriod_s * i + (i > kSettled && i % 4 == 0 ? 0.008 : 0.0));
    sample.f_ib_b = {std::sin(i), std::cos(i), -9.8 + 0.1 * std::sin(2.0 * i)};
    sample.omega_ib_b = 0.01 * sample.f_ib_b;
    samples.push_back(sample);
  }
  const std::vector<TimedInterval> intervals = imuIntervals(samples, ImuInputParams());
  ASSERT_GE(intervals.size(), samples.size() - 5);
  for (std::size_t i = 2 * kSettled; i < intervals.size(); ++i) {
    ASSERT_NEAR(toSeconds(intervals[i].end - intervals[i].start), kPeriod_s, 2e-4) << i;
  }
}

}  // namespace
}  // namespace slipnav
