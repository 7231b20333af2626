#include "evaluation/loop_closure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipnav {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A circle of 100 m, driven at 1 m/s; the last estimate is off by 0.3 m east, 0.4 m north and 0.1 m up.
EstimateTrack circle() {
  EstimateTrack track;
  track.reserve(1001);
  for (int i = 0; i <= 1000; ++i) {
    const double share = 0.001 * i;
    EstimateSample sample;
    sample.stamp = fromSeconds(100.0 * share);
    sample.position_enu_m = Vector3(std::cos(2.0 * kPi * share) - 1.0, std::sin(2.0 * kPi * share), 0.0) * 50.0 / kPi +
                            share * Vector3(0.3, 0.4, 0.1);
    sample.covariance_enu_m2 = Vector3(4.0 + 0.01 * share, 4.0 + 0.04 * share, 4.0).asDiagonal();
    track.push_back(sample);
  }
  return track;
}

TEST(LoopClosure, ByHandOnACircle) {
  Metrics metrics;
  addLoopClosure(circle(), true, metrics);
  EXPECT_NEAR(*metrics.closure_m, 0.5, 1e-9);
  EXPECT_NEAR(*metrics.closure_up_m, 0.1, 1e-9);
  EXPECT_NEAR(*metrics.distance_m, 100.0, 0.3);
  EXPECT_NEAR(*metrics.closure_pct, 0.5, 0.002);
  EXPECT_NEAR(*metrics.closure_3sigma_m, 3.0 * std::sqrt(0.04), 1e-9);  // without the 2 m of the start
  EXPECT_EQ(metrics.verdict.rfind("consistent: returns to its start within 0.5 m, 0.5 % of the distance", 0), 0U)
      << metrics.verdict;
}

TEST(LoopClosure, BeyondThreeSigmaIsOverConfident) {
  EstimateTrack track = circle();
  track.back().position_enu_m.x() += 0.5;
  Metrics metrics;
  addLoopClosure(track, true, metrics);
  EXPECT_EQ(metrics.verdict.rfind("over-confident: returns to its start within 0.894 m", 0), 0U) << metrics.verdict;
}

TEST(LoopClosure, TruthKeepsItsDistanceAndItsVerdict) {
  Metrics metrics;
  metrics.distance_m = 50.0;
  metrics.coverage_3sigma_pct = 100.0;
  metrics.position_nees_mean = 1.0;
  addLoopClosure(circle(), true, metrics);
  EXPECT_EQ(metrics.verdict, "consistent");
  EXPECT_NEAR(*metrics.closure_pct, 1.0, 1e-6);
}

TEST(LoopClosure, NeedsAnEstimate) {
  Metrics metrics;
  EXPECT_THROW(addLoopClosure({}, true, metrics), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
