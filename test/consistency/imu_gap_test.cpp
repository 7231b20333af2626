/// Is the covariance honest after the IMU has been silent on rough ground, or the clock has jumped?

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "monte_carlo.h"

namespace slipnav::test {
namespace {

constexpr int kDrives = 24;
constexpr double kDistance_m = 150.0;
constexpr double kEarliest_s = 60.0;
/// Gaps begin at different times of the stop cycle.
constexpr double kShift_s = 0.7;
/// Not below: a covariance that is far too large says nothing either.
constexpr Range kAnees{0.15, 1.5};

Disturbance imuGap(double duration_s) { return {0.0, duration_s, 0.0, 0.0}; }

class ImuGaps : public ::testing::TestWithParam<Disturbance> {};

std::vector<DriveResult> drives(const Disturbance& disturbance) {
  return runDrives(kDrives, [&disturbance](int drive) {
    Config config;
    config.simulator.seed = 3000 + drive;
    config.simulator.drive.distance_m = kDistance_m;
    Disturbance this_one = disturbance;
    this_one.begin_s = kEarliest_s + kShift_s * drive;
    return runDrive(config, "periodic:12:3", this_one);
  });
}

TEST_P(ImuGaps, TheCovarianceSaysWhatTheyCost) {
  double attitude = 0.0;
  double position = 0.0;
  double coverage_pct = 0.0;
  std::vector<double> final_m;
  for (const DriveResult& result : drives(GetParam())) {
    const ErrorVector normalized = result.final_error.cwiseQuotient(result.final_sigma.cwiseMax(1e-12));
    attitude += normalized.segment<3>(kAttitude).squaredNorm() / (3.0 * kDrives);
    position += normalized.segment<2>(kPosition).squaredNorm() / (2.0 * kDrives);
    coverage_pct += result.coverage_3sigma_pct / kDrives;
    final_m.push_back(result.final_error.segment<2>(kPosition).norm());
  }
  std::sort(final_m.begin(), final_m.end());
  const Disturbance& what = GetParam();
  std::printf(
      "IMU silent for %.1f s, wheels for %.1f s, clock ahead by %.1f s: attitude %.2f position %.2f, coverage %.2f %%, "
      "final error %.2f m (worst %.2f m)\n",
      what.imu_gap_s, what.wheel_gap_s, what.clock_jump_s, attitude, position, coverage_pct,
      final_m[final_m.size() / 2], final_m.back());
  EXPECT_GE(position, kAnees.min);
  EXPECT_LE(position, kAnees.max);
  EXPECT_LE(attitude, kAnees.max);
  EXPECT_GE(coverage_pct, 98.0);
}

INSTANTIATE_TEST_SUITE_P(Durations, ImuGaps,
                         ::testing::Values(imuGap(0.1), imuGap(0.3), imuGap(1.0), imuGap(2.0), imuGap(5.0)));

/// As when the computer hangs.
INSTANTIATE_TEST_SUITE_P(WheelsAsWell, ImuGaps,
                         ::testing::Values(Disturbance{0.0, 1.0, 1.0, 0.0}, Disturbance{0.0, 3.0, 3.0, 0.0}));

/// The rover stays where it is, and nobody can tell from a gap.
INSTANTIATE_TEST_SUITE_P(ClockJumps, ImuGaps,
                         ::testing::Values(Disturbance{0.0, 0.0, 0.0, 1.0}, Disturbance{0.0, 0.0, 0.0, 3.0}));

}  // namespace
}  // namespace slipnav::test
