/// Once its buffers have their size, the core takes no memory for a sample: no allocator can delay an estimate.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "recorded_drive.h"

namespace {

bool counting = false;
std::size_t allocations = 0;

void* allocateOrNull(std::size_t size) noexcept {
  allocations += counting ? 1 : 0;
  return std::malloc(size);
}

}  // namespace

#include "replaced_new.h"

namespace slipnav::test {
namespace {

TEST(Navigator, TakesNoMemoryWhileItRuns) {
  const Config config = driveConfig(6.0);
  const RecordedDrive drive = recordDrive(config);
  const NavigationSetup setup = config.navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive.initial);
  std::size_t estimates = 0;
  const FilterEngine::EstimateSink sink = [&estimates](const Estimate&, const ErrorCovariance&) { ++estimates; };
  const auto push = [&](std::size_t i) {
    const DriveSample& sample = drive.samples[i];
    sample.is_imu ? static_cast<void>(navigator.push(sample.imu, sink))
                  : static_cast<void>(navigator.push(sample.wheels, sink));
  };
  const std::size_t half = drive.samples.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    push(i);
  }
  const std::size_t before = estimates;
  allocations = 0;
  counting = true;
  for (std::size_t i = half; i < drive.samples.size(); ++i) {
    push(i);
  }
  counting = false;
  EXPECT_GT(estimates, before + 200);
  EXPECT_EQ(allocations, 0U);
}

}  // namespace
}  // namespace slipnav::test
