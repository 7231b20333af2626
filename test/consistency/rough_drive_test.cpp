/// Is the covariance honest? Normalized estimation errors and innovations over many drives on rough ground.

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cstdio>
#include <vector>

#include "monte_carlo.h"

namespace slipnav::test {
namespace {

/// Enough that the average of one minute strays by 0.13.
constexpr int kDrives = 40;
constexpr double kDistance_m = 650.0;
/// What the average normalized estimation error squared, per degree of freedom, may be: 1 is exact.
/// The filter does not know this ground before it drives on it, and is cautious by about a factor of two.
constexpr Range kAnees{0.1, 1.6};
/// Of the velocity at a minute that may fall on a stop, or just before one.
constexpr Range kVelocityAnees{0.03, 2.5};
/// Noise that lasts counts as a density: single innovations are smaller.
constexpr double kLargestNis = 1.3;

std::vector<DriveResult> drives(const std::string& policy) {
  return runDrives(kDrives, [&policy](int drive) {
    Config config;
    config.simulator.seed = 1000 + drive;
    config.simulator.drive.distance_m = kDistance_m;
    return runDrive(config, policy);
  });
}

/// Mean over the drives that last so long, per degree of freedom.
Nees average(const std::vector<DriveResult>& results, std::size_t minute) {
  Nees mean;
  double count = 0.0;
  for (const DriveResult& result : results) {
    if (result.by_minute.size() > minute) {
      mean.attitude += result.by_minute[minute].attitude / 3.0;
      mean.velocity += result.by_minute[minute].velocity / 3.0;
      mean.position += result.by_minute[minute].position / 3.0;
      count += 1.0;
    }
  }
  return {mean.attitude / count, mean.velocity / count, mean.position / count};
}

/// Minutes that every drive reaches.
std::size_t commonMinutes(const std::vector<DriveResult>& results) {
  std::size_t minutes = results.front().by_minute.size();
  for (const DriveResult& result : results) {
    minutes = std::min(minutes, result.by_minute.size());
  }
  return minutes;
}

void expectWithin(double value, const Range& range, const std::string& what) {
  EXPECT_GE(value, range.min) << what;
  EXPECT_LE(value, range.max) << what;
}

class RoughDrives : public ::testing::TestWithParam<const char*> {};

TEST_P(RoughDrives, CovarianceIsHonestAtEveryMinute) {
  const std::vector<DriveResult> results = drives(GetParam());
  const boost::math::chi_squared exact(3.0 * kDrives);
  std::printf("95 %% of averages over %d drives lie in [%.2f, %.2f] when the filter is exact\n", kDrives,
              quantile(exact, 0.025) / (3.0 * kDrives), quantile(exact, 0.975) / (3.0 * kDrives));
  for (std::size_t minute = 0; minute < commonMinutes(results); ++minute) {
    const Nees nees = average(results, minute);
    const std::string when = "minute " + std::to_string(minute + 1);
    std::printf("%s: attitude %.2f velocity %.2f position %.2f\n", when.c_str(), nees.attitude, nees.velocity,
                nees.position);
    expectWithin(nees.attitude, kAnees, "attitude, " + when);
    expectWithin(nees.velocity, kVelocityAnees, "velocity, " + when);
    expectWithin(nees.position, kAnees, "position, " + when);
  }
  double coverage_pct = 0.0;
  for (const DriveResult& result : results) {
    coverage_pct += result.coverage_3sigma_pct / kDrives;
  }
  std::printf("coverage of 3 sigma: %.2f %%\n", coverage_pct);
  EXPECT_GE(coverage_pct, 99.0);

  for (const Component component : {kForwardSpeed, kYawRate, kLateral, kVertical, kZeroVelocity, kZeroRate}) {
    ComponentStatus total;
    for (const DriveResult& result : results) {
      total.accepted += result.components[component].accepted;
      total.rejected += result.components[component].rejected;
      total.nis_sum += result.components[component].nis_sum;
    }
    const double nis = total.nis_sum / static_cast<double>(total.accepted);
    std::printf("%s: mean NIS %.2f, %.2f %% rejected\n", componentName(component), nis,
                100.0 * static_cast<double>(total.rejected) / static_cast<double>(total.accepted + total.rejected));
    EXPECT_LE(nis, kLargestNis) << componentName(component);
  }
}

INSTANTIATE_TEST_SUITE_P(Policies, RoughDrives, ::testing::Values("periodic:12:3", "periodic:30:3"),
                         [](const auto& policy) { return std::string(policy.index == 0 ? "Every12s" : "Every30s"); });

}  // namespace
}  // namespace slipnav::test
