#include "evaluation/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace slipnav {
namespace {

/// Truth and estimate at 10 Hz along a straight line to the east at 1 m/s for 100 s; `error(i)` is added to the
/// estimate at epoch i.
template <class ErrorOf>
MetricsInput straightDrive(ErrorOf error) {
  MetricsInput input;
  std::vector<TruthSample> truth;
  for (int i = 0; i <= 1000; ++i) {
    TruthSample sample;
    sample.stamp = fromSeconds(1000.0) + i * fromSeconds(0.1);
    sample.position_enu_m = {0.1 * i, 0.0, 0.0};
    truth.push_back(sample);
    EstimateSample estimate;
    estimate.stamp = sample.stamp;
    estimate.position_enu_m = sample.position_enu_m + error(i);
    estimate.covariance_enu_m2 = Vector3(0.01, 0.04, 0.09).asDiagonal();
    input.estimates.push_back(estimate);
  }
  input.truth = TruthTrack(truth);
  return input;
}

/// East error 3 m in the first half and 1 m in the second; north 0 and 4 m; up 2 m.
Vector3 steppedError(int i) { return i <= 499 ? Vector3(3.0, 0.0, 2.0) : Vector3(1.0, 4.0, -2.0); }

TEST(Metrics, errorsByHand) {
  const Metrics metrics = computeMetrics(straightDrive(steppedError));
  // 500 epochs of the first kind, 501 of the second
  const double first = 500.0 / 1001.0;
  const double second = 501.0 / 1001.0;
  const double late_m = std::sqrt(17.0);
  EXPECT_NEAR(*metrics.rms_east_m, std::sqrt(9.0 * first + second), 1e-9);
  EXPECT_NEAR(*metrics.rms_north_m, 4.0 * std::sqrt(second), 1e-9);
  EXPECT_NEAR(*metrics.rms_up_m, 2.0, 1e-9);
  EXPECT_NEAR(*metrics.horizontal_median_m, late_m, 1e-9);
  EXPECT_NEAR(*metrics.horizontal_max_m, late_m, 1e-9);
  EXPECT_NEAR(*metrics.horizontal_final_m, late_m, 1e-9);
  EXPECT_NEAR(*metrics.horizontal_std_m, (late_m - 3.0) * std::sqrt(first * second), 1e-9);
  EXPECT_NEAR(*metrics.distance_m, 100.0, 1e-6);
  EXPECT_NEAR(metrics.duration_s, 100.0, 1e-12);
  const double rms_squared = 9.0 * first + second + 16.0 * second + 4.0;
  EXPECT_NEAR(*metrics.enu_error_pct, std::sqrt(rms_squared), 1e-6);
  EXPECT_NEAR(*metrics.median_error_pct, late_m, 1e-6);
}

TEST(Metrics, finalErrorIsTheLastOneNotTheLargest) {
  const Metrics metrics = computeMetrics(straightDrive([](int i) { return Vector3(i < 999 ? 5.0 : 0.5, 0.0, 0.0); }));
  EXPECT_NEAR(*metrics.horizontal_final_m, 0.5, 1e-9);
  EXPECT_NEAR(*metrics.horizontal_max_m, 5.0, 1e-9);
}

TEST(Metrics, evaluatesAtTruthEpochs) {
  MetricsInput input = straightDrive([](int) { return Vector3(0.0, 2.0, 0.0); });
  // the estimate half an interval later than truth, and only from the middle on
  input.estimates.erase(input.estimates.begin(), input.estimates.begin() + 500);
  for (EstimateSample& estimate : input.estimates) {
    estimate.stamp += fromSeconds(0.05);
    estimate.position_enu_m.x() += 0.05;
  }
  const Metrics metrics = computeMetrics(input);
  EXPECT_NEAR(*metrics.rms_east_m, 0.0, 1e-9);
  EXPECT_NEAR(*metrics.rms_north_m, 2.0, 1e-9);
  // truth from 50.1 s to 100.0 s
  EXPECT_NEAR(*metrics.distance_m, 49.9, 1e-6);
  EXPECT_NEAR(metrics.duration_s, 50.0, 1e-9);
}

TEST(Metrics, neesAndCoverageByHand) {
  // deviations 0.1, 0.2, 0.3 m: one, two and three sigma, then 3.1 sigma in up alone
  const Metrics metrics = computeMetrics(
      straightDrive([](int i) { return i <= 499 ? Vector3(0.1, -0.4, 0.9 - 1e-9) : Vector3(0.0, 0.0, -0.93); }));
  const double first = (1.0 + 4.0 + 9.0) / 3.0;
  const double second = 3.1 * 3.1 / 3.0;
  EXPECT_NEAR(*metrics.position_nees_mean, (500.0 * first + 501.0 * second) / 1001.0, 1e-6);
  EXPECT_NEAR(*metrics.coverage_3sigma_pct, 100.0 * (3.0 * 1001.0 - 501.0) / (3.0 * 1001.0), 1e-9);
}

TEST(Metrics, neesUsesTheWholeCovariance) {
  MetricsInput input = straightDrive([](int) { return Vector3(1.0, 1.0, 0.0); });
  Matrix3 covariance;
  covariance << 2.0, 1.0, 0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 1.0;
  for (EstimateSample& estimate : input.estimates) {
    estimate.covariance_enu_m2 = covariance;
  }
  // the inverse of [2 1; 1 2] is [2 −1; −1 2]/3
  EXPECT_NEAR(*computeMetrics(input).position_nees_mean, 2.0 / 9.0, 1e-12);
}

TEST(Metrics, honestCovarianceGivesNeesOfOneAndNominalCoverage) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  const Metrics metrics = computeMetrics(
      straightDrive([&](int) { return Vector3(0.1 * normal(random), 0.2 * normal(random), 0.3 * normal(random)); }));
  EXPECT_NEAR(*metrics.position_nees_mean, 1.0, 0.08);  // three sigma of a mean of 1001 chi-square(3)/3
  EXPECT_NEAR(*metrics.coverage_3sigma_pct, 99.73, 0.3);
}

TEST(Metrics, canTakeTheNoiseOfTruthIntoAccount) {
  MetricsInput input = straightDrive([](int) { return Vector3(0.3, 0.0, 0.0); });
  std::vector<TruthSample> samples = input.truth.samples();
  for (TruthSample& sample : samples) {
    sample.covariance_enu_m2 = 0.08 * Matrix3::Identity();
  }
  input.truth = TruthTrack(samples);
  EXPECT_NEAR(*computeMetrics(input).position_nees_mean, 0.09 / 0.09 / 3.0, 1e-9);
  MetricsOptions options;
  options.add_truth_covariance = false;
  EXPECT_NEAR(*computeMetrics(input, options).position_nees_mean, 0.09 / 0.01 / 3.0, 1e-9);
}

TEST(Metrics, neesIsUnknownWithoutCovariance) {
  MetricsInput input = straightDrive(steppedError);
  for (EstimateSample& estimate : input.estimates) {
    estimate.covariance_enu_m2.setZero();
  }
  const Metrics metrics = computeMetrics(input);
  EXPECT_FALSE(metrics.position_nees_mean.has_value());
  EXPECT_NEAR(*metrics.coverage_3sigma_pct, 100.0 * 500.0 / 3003.0, 1e-9) << "only the exact north errors are covered";
}

TEST(Metrics, countsStopsAndTheirShareOfTime) {
  MetricsInput input = straightDrive(steppedError);
  for (std::size_t i = 0; i < input.estimates.size(); ++i) {
    input.estimates[i].stationary = i < 50 || (i >= 300 && i < 330) || (i >= 600 && i < 645);
  }
  const Metrics metrics = computeMetrics(input);
  EXPECT_EQ(metrics.stop_count, 2);
  EXPECT_NEAR(*metrics.stop_rate_pct, 7.5, 1e-9);
}

TEST(Metrics, wheelOnlyErrorIsTheFinalOneOverTheDistance) {
  MetricsInput input = straightDrive(steppedError);
  for (int i = 0; i <= 950; ++i) {
    // ends 95 m east of the start in truth, told as 89 m east and 8 m north
    input.wheel_only.push_back({fromSeconds(1000.0) + i * fromSeconds(0.1), 89.0 * i / 950.0, 8.0 * i / 950.0, 0.0});
  }
  EXPECT_NEAR(*computeMetrics(input).wheel_only_error_pct, 10.0, 1e-6);
}

TEST(Metrics, passesOnWhatTheRunTold) {
  MetricsInput input = straightDrive(steppedError);
  input.no_zupt_error_pct = 12.5;
  input.counters = {4750, 950, 3, 90, {1.0, 2.0, 3.0, 4.0, 5.0}, 1.5, 60.0};
  const Metrics metrics = computeMetrics(input);
  EXPECT_EQ(metrics.no_zupt_error_pct, std::optional<double>(12.5));
  EXPECT_EQ(metrics.imu_samples, 4750);
  EXPECT_EQ(metrics.wheel_samples, 950);
  EXPECT_EQ(metrics.rejected_samples, 3);
  EXPECT_EQ(metrics.forecasts, 90);
  EXPECT_DOUBLE_EQ(*metrics.forecast_ms_p50, 3.0);
  EXPECT_DOUBLE_EQ(*metrics.forecast_ms_p99, 4.96);
  EXPECT_EQ(metrics.cpu_s, std::optional<double>(1.5));
  EXPECT_EQ(metrics.realtime_factor, std::optional<double>(60.0));
}

TEST(Metrics, knowsNoErrorsWithoutTruth) {
  MetricsInput input = straightDrive(steppedError);
  input.truth = TruthTrack();
  const Metrics metrics = computeMetrics(input);
  EXPECT_FALSE(metrics.distance_m.has_value());
  EXPECT_FALSE(metrics.enu_error_pct.has_value());
  EXPECT_FALSE(metrics.horizontal_final_m.has_value());
  EXPECT_FALSE(metrics.wheel_only_error_pct.has_value());
  EXPECT_FALSE(metrics.forecast_ms_p50.has_value());
  EXPECT_NEAR(metrics.duration_s, 100.0, 1e-12);
  EXPECT_EQ(metrics.stop_rate_pct, std::optional<double>(0.0));
}

TEST(Metrics, refusesEstimatesOutOfOrder) {
  MetricsInput input = straightDrive(steppedError);
  std::swap(input.estimates[10], input.estimates[11]);
  EXPECT_THROW(computeMetrics(input), std::invalid_argument);
  EXPECT_THROW(computeMetrics(MetricsInput()), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
