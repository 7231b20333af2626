/// What a drive knows afterwards: closer to truth than the filter, with a covariance that is smaller and holds.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <vector>

#include "config/config.h"
#include "evaluation/simulated_run.h"
#include "slipnav/core/ekf/engine/filter_history.h"
#include "slipnav/core/navigation/pipeline.h"

namespace slipnav::test {
namespace {

constexpr int kDrives = 12;
constexpr double kDistance_m = 150.0;
/// Of the mean squared error by its covariance. Over twelve drives a mean of the heading strays by 0.4.
constexpr double kLargestNees = 1.4;
/// Truth at the epochs is a mean over the drive as well: the filter is cautious by a factor of three to ten on this
/// ground.
constexpr double kLeastNees = 0.05;

/// A block of three error states, and what of the filter's RMS error may be left after smoothing.
struct Block {
  const char* name;
  int index;
  double largest_ratio;
};

/// Heading has no measurement at all, position none after the start: what is gained there comes through the others.
constexpr std::array<Block, 4> kBlocks = {{{"tilt", kAttitude, 0.4},
                                           {"velocity", kVelocity, 0.5},
                                           {"position", kPosition, 1.0},
                                           {"gyro bias", kGyroBias, 1.0}}};

/// Sums over the epochs of drives, of the error squared and of that by its covariance per degree of freedom.
struct Spread {
  double squared = 0.0;
  double nees = 0.0;
};

struct FilterEpoch {
  NavigationState nav;
  ErrorCovariance P;
};

/// One simulated drive with stops, filtered and smoothed.
struct Drive {
  std::map<Nanoseconds, NavigationState> truth;
  std::vector<FilterEpoch> filtered;
  std::vector<SmoothedState> smoothed;
};

/// Of a quaternion that is normalized once more.
constexpr double kRounding = 1e-14;

/// The IMU is silent for that long, in the middle of the drive.
constexpr double kGap_s = 1.0;

/// @param with_gap of the IMU
Drive drive(int seed, bool with_history, bool with_gap = false) {
  Config config;
  config.simulator.seed = seed;
  config.simulator.drive.distance_m = kDistance_m;
  const Planet planet = Planet::byName(config.planet);
  const WheelGeometry geometry = config.wheelGeometry();
  Drive result;
  Pipeline pipeline(planet, config.navigation(), [&result](const Estimate& estimate, const ErrorCovariance& P) {
    result.filtered.push_back({estimate.nav, P});
  });
  const auto history = std::make_shared<FilterHistory>(planet);
  if (with_history) {
    pipeline.keepHistory(history);
  }
  const std::unique_ptr<StopPolicy> stops = makeStopPolicy("periodic:30:3", config.stop);
  Nanoseconds gap_begin = 0;
  simulateDrive(config.simulator, planet, *stops, [&](const sim::Measurements& samples, const sim::TruthState& truth) {
    result.truth[truth.stamp] = toNavState(truth, planet, config.imu.mount.position_b());
    const double into_gap_m = truth.distance_m - 0.5 * kDistance_m;
    gap_begin = gap_begin == 0 && into_gap_m > 0.0 ? truth.stamp : gap_begin;
    if (!with_gap || gap_begin == 0 || truth.stamp > gap_begin + fromSeconds(kGap_s)) {
      pushMeasurements(samples, geometry, pipeline);
    } else if (samples.wheel) {
      pipeline.push(toWheelMotion(geometry, *samples.wheel));
    }
  });
  result.smoothed = history->smooth();
  return result;
}

/// The filter's epochs at the stamps of the smoothed ones.
std::vector<FilterEpoch> alike(const Drive& drive) {
  std::vector<FilterEpoch> epochs;
  epochs.reserve(drive.smoothed.size());
  auto next = drive.filtered.begin();
  for (const SmoothedState& epoch : drive.smoothed) {
    while (next->nav.stamp < epoch.nav.stamp) {
      ++next;
    }
    EXPECT_EQ(next->nav.stamp, epoch.nav.stamp);
    epochs.push_back(*next);
  }
  return epochs;
}

/// @param size 2 for the tilt, whose third axis is the heading
void add(const ErrorVector& error, const ErrorCovariance& P, const Block& block, Spread& spread) {
  const Eigen::Index size = block.index == kAttitude ? 2 : 3;
  const Eigen::VectorXd e = error.segment(block.index, size);
  spread.squared += e.squaredNorm();
  spread.nees += e.dot(P.block(block.index, block.index, size, size).llt().solve(e)) / static_cast<double>(size);
}

class SmoothedDrives : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    drives_.reserve(kDrives);
    for (int i = 1; i <= kDrives; ++i) {
      drives_.push_back(drive(i, true));
    }
  }
  static void TearDownTestSuite() { drives_.clear(); }

  static std::vector<Drive> drives_;
};

std::vector<Drive> SmoothedDrives::drives_;

TEST_F(SmoothedDrives, AreCloserToTruthThanTheFilterAndCovered) {
  const Planet planet = Planet::byName("earth");
  for (const Block& block : kBlocks) {
    Spread filter;
    Spread smoothed;
    double count = 0.0;
    for (const Drive& drive : drives_) {
      const std::vector<FilterEpoch> filtered = alike(drive);
      for (std::size_t i = 0; i < filtered.size(); ++i) {
        const NavigationState& truth = drive.truth.at(filtered[i].nav.stamp);
        add(errorBetween(planet, filtered[i].nav, truth), filtered[i].P, block, filter);
        add(errorBetween(planet, drive.smoothed[i].nav, truth), drive.smoothed[i].P, block, smoothed);
        ++count;
      }
    }
    const double ratio = std::sqrt(smoothed.squared / filter.squared);
    std::printf("%s: RMS smoothed over filter %.2f, NEES of the filter %.2f, smoothed %.2f\n", block.name, ratio,
                filter.nees / count, smoothed.nees / count);
    EXPECT_LT(ratio, block.largest_ratio) << block.name;
    EXPECT_GT(smoothed.nees / count, kLeastNees) << block.name;
    EXPECT_LT(smoothed.nees / count, kLargestNees) << block.name;
  }
}

/// By eigenvalues, in units of the filter's own deviations. The yaw scale is considered: its cross terms are no gain.
TEST_F(SmoothedDrives, NoEpochIsLessCertainThanTheFilterHadIt) {
  double most_gained = 0.0;
  for (const Drive& drive : drives_) {
    const std::vector<FilterEpoch> filtered = alike(drive);
    for (std::size_t i = 0; i < filtered.size(); i += 10) {
      const ErrorVector weight = filtered[i].P.diagonal().cwiseSqrt().cwiseInverse();
      const ErrorCovariance gained = weight.asDiagonal() * (filtered[i].P - drive.smoothed[i].P) * weight.asDiagonal();
      const Eigen::Vector3d position =
          Eigen::SelfAdjointEigenSolver<Matrix3>(gained.block<3, 3>(kPosition, kPosition)).eigenvalues();
      EXPECT_GT(position.minCoeff(), -0.01);
      EXPECT_EQ(Eigen::LLT<ErrorCovariance>(drive.smoothed[i].P).info(), Eigen::Success);
      most_gained = std::max(most_gained, gained(kVelocity, kVelocity));
    }
  }
  EXPECT_GT(most_gained, 0.9);
}

TEST_F(SmoothedDrives, EndWhereTheFilterEnds) {
  for (const Drive& drive : drives_) {
    const NavigationState& filter = drive.filtered.back().nav;
    const SmoothedState& last = drive.smoothed.back();
    EXPECT_EQ(last.nav.stamp, filter.stamp);
    EXPECT_LT(errorBetween(Planet::byName("earth"), last.nav, filter).cwiseAbs().maxCoeff(), kRounding);
    EXPECT_EQ(last.P, drive.filtered.back().P);
  }
}

/// What is forgotten in a gap, and what is opened after it, is no news of what was before.
TEST_F(SmoothedDrives, AGapOfTheImuLeavesThemCovered) {
  const Planet planet = Planet::byName("earth");
  for (int seed = 1; seed <= 4; ++seed) {
    const Drive gap = drive(seed, true, true);
    const std::vector<FilterEpoch> filtered = alike(gap);
    const Block velocity = kBlocks[1];
    Spread filter;
    Spread smoothed;
    for (std::size_t i = 0; i < filtered.size(); ++i) {
      const NavigationState& truth = gap.truth.at(filtered[i].nav.stamp);
      add(errorBetween(planet, filtered[i].nav, truth), filtered[i].P, velocity, filter);
      add(errorBetween(planet, gap.smoothed[i].nav, truth), gap.smoothed[i].P, velocity, smoothed);
      EXPECT_EQ(Eigen::LLT<ErrorCovariance>(gap.smoothed[i].P).info(), Eigen::Success);
    }
    const double ratio = std::sqrt(smoothed.squared / filter.squared);
    std::printf("gap, drive %d: velocity RMS smoothed over filter %.2f, NEES %.2f and %.2f\n", seed, ratio,
                filter.nees / static_cast<double>(filtered.size()),
                smoothed.nees / static_cast<double>(filtered.size()));
    EXPECT_LT(ratio, velocity.largest_ratio);
    EXPECT_LT(smoothed.nees, kLargestNees * static_cast<double>(filtered.size()));
  }
}

TEST_F(SmoothedDrives, TheFilterDoesNotKnowThatItIsWatched) {
  const Drive unwatched = drive(1, false);
  ASSERT_EQ(unwatched.filtered.size(), drives_[0].filtered.size());
  for (std::size_t i = 0; i < unwatched.filtered.size(); ++i) {
    ASSERT_EQ(unwatched.filtered[i].P, drives_[0].filtered[i].P);
    ASSERT_EQ(unwatched.filtered[i].nav.v_eb_n, drives_[0].filtered[i].nav.v_eb_n);
  }
  EXPECT_TRUE(unwatched.smoothed.empty());
}

TEST(SmoothedRun, StandsInTheReportBesideTheFilter) {
  Config config;
  config.simulator.drive.distance_m = 30.0;
  const std::unique_ptr<StopPolicy> stops = makeStopPolicy("periodic:15:3", config.stop);
  const RunReport report = simulateAndMeasure(config, *stops, {}, false, true).run;
  ASSERT_TRUE(report.smoothed);
  const EstimateSample& last = report.smoothed->estimates.back();
  EXPECT_EQ(last.stamp, report.estimates.back().stamp);
  EXPECT_LT((last.position_enu_m - report.estimates.back().position_enu_m).norm(), 1e-9);
  EXPECT_LT((last.covariance_enu_m2 - report.estimates.back().covariance_enu_m2).norm(), 1e-12);
  EXPECT_EQ(report.smoothed->estimates.front().stamp, report.estimates.front().stamp);
  EXPECT_EQ(report.smoothed->metrics.stop_count, report.metrics.stop_count);
  EXPECT_LT(*report.smoothed->metrics.horizontal_max_m, *report.metrics.horizontal_max_m);
  std::size_t slips = 0;
  for (const EstimateSample& sample : report.smoothed->estimates) {
    const auto filtered = interpolate(report.estimates, sample.stamp, 1.0);
    EXPECT_EQ(sample.stationary, filtered->stationary);
    EXPECT_FALSE(sample.stationary && sample.slip);
    slips += sample.slip ? 1 : 0;
  }
  EXPECT_GT(2 * slips, report.smoothed->estimates.size());
  EXPECT_FALSE(simulateAndMeasure(config, *makeStopPolicy("periodic:15:3", config.stop), {}, false).run.smoothed);
}

}  // namespace
}  // namespace slipnav::test
