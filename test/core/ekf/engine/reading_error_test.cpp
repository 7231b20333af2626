/// Wheel speeds that are wrong for a single sample.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "recorded_drive.h"

namespace slipnav::test {
namespace {

constexpr std::size_t kEvery = 40;    // wheel samples, four seconds
constexpr double kCounted_mps = 1.5;  // too much in one interval, and too little in the next

/// Counts that arrive an interval early.
std::vector<DriveSample> withReadingErrors(std::vector<DriveSample> samples) {
  std::size_t count = 0;
  for (DriveSample& sample : samples) {
    if (!sample.is_imu && sample.wheels.motion.forward_mps > 0.1) {
      const std::size_t place = count++ % kEvery;
      if (place < 2) {
        sample.wheels.motion.forward_mps += place == 0 ? kCounted_mps : -kCounted_mps;
      }
    }
  }
  return samples;
}

double largestSlip(const Config& config, const RecordedDrive& drive, const std::vector<DriveSample>& samples) {
  double largest = 0.0;
  for (const LoggedEstimate& logged : runNavigator(config, drive.initial, samples)) {
    largest = std::max(largest, std::abs(logged.estimate.vehicle.fast_slip));
  }
  return largest;
}

/// A filter that took each for slip would have to forget it before the wheels say anything about the speed again.
TEST(ReadingError, IsNotTakenForSlip) {
  Config config = driveConfig(40.0);
  config.simulator.terrain = "paved";
  const RecordedDrive drive = recordDrive(config);
  EXPECT_LT(largestSlip(config, drive, withReadingErrors(drive.samples)), 0.5);
}

}  // namespace
}  // namespace slipnav::test
