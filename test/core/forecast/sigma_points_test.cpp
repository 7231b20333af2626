#include "core/forecast/sigma_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace slipnav {
namespace {

constexpr double kSpeed = 0.8;

TEST(SigmaPoints, SlipRatioInverts) {
  // s = 1 − v/(rω) driving, s = rω/v − 1 braking
  for (const double wheel : {0.4, 0.79, 0.8, 0.81, 2.0}) {
    const double slip = wheel >= kSpeed ? 1.0 - kSpeed / wheel : wheel / kSpeed - 1.0;
    EXPECT_NEAR(wheelSpeedFromSlip(kSpeed, slip), wheel, 1e-15);
  }
}

TEST(SigmaPoints, ExactWhereTheMapIsLinear) {
  // Braking is linear in slip; all points stay on that side.
  for (const double spread : {1.0, std::sqrt(1.5), std::sqrt(3.0), 2.5}) {
    SigmaPointParameters parameters;
    parameters.spread = spread;
    const WheelSpeedPrediction prediction = SigmaPoints(parameters).predict(kSpeed, -0.3, 0.05);
    EXPECT_NEAR(prediction.mean_mps, kSpeed * 0.7, 1e-14);
    EXPECT_NEAR(prediction.variance, kSpeed * kSpeed * 0.05 * 0.05, 1e-15);
    EXPECT_NEAR(prediction.sensitivity_mps, kSpeed, 1e-12);
  }
}

TEST(SigmaPoints, AgreesWithSamplingWhereItIsNot) {
  struct Case {
    double mean;
    double stddev;
  };
  for (const Case& slip : {Case{0.2, 0.05}, Case{0.0, 0.07}, Case{0.4, 0.06}}) {
    std::mt19937 generator(3);
    std::normal_distribution<double> normal(slip.mean, slip.stddev);
    constexpr int kSamples = 400000;
    double sum = 0.0;
    double squares = 0.0;
    double cross = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const double s = normal(generator);
      const double wheel = wheelSpeedFromSlip(kSpeed, s);
      sum += wheel;
      squares += wheel * wheel;
      cross += wheel * (s - slip.mean);
    }
    const double mean = sum / kSamples;
    const double variance = squares / kSamples - mean * mean;
    const WheelSpeedPrediction prediction = SigmaPoints({}).predict(kSpeed, slip.mean, slip.stddev);
    EXPECT_NEAR(prediction.mean_mps, mean, 0.02 * std::sqrt(variance));
    EXPECT_NEAR(prediction.variance / variance, 1.0, 0.06);
    EXPECT_NEAR(prediction.sensitivity_mps / (cross / kSamples / (slip.stddev * slip.stddev)), 1.0, 0.05);
  }
}

TEST(SigmaPoints, WeightedMeanAndVarianceOfThreePoints) {
  const double mean_slip = 0.3;
  const double reach = std::sqrt(3.0) * 0.1;
  const double center = wheelSpeedFromSlip(kSpeed, mean_slip);
  const double above = wheelSpeedFromSlip(kSpeed, mean_slip + reach);
  const double below = wheelSpeedFromSlip(kSpeed, mean_slip - reach);
  const double mean = 2.0 / 3.0 * center + (above + below) / 6.0;
  const double variance = 2.0 / 3.0 * (center - mean) * (center - mean) +
                          ((above - mean) * (above - mean) + (below - mean) * (below - mean)) / 6.0;
  const WheelSpeedPrediction prediction = SigmaPoints({}).predict(kSpeed, mean_slip, 0.1);
  EXPECT_NEAR(prediction.mean_mps, mean, 1e-14);
  EXPECT_NEAR(prediction.variance, variance, 1e-14);
}

TEST(SigmaPoints, NoSpreadIsTheMapItself) {
  for (const double slip : {-0.4, 0.0, 0.3}) {
    const WheelSpeedPrediction prediction = SigmaPoints({}).predict(kSpeed, slip, 0.0);
    EXPECT_DOUBLE_EQ(prediction.mean_mps, wheelSpeedFromSlip(kSpeed, slip));
    EXPECT_EQ(prediction.variance, 0.0);
    const double numeric = (wheelSpeedFromSlip(kSpeed, slip + 1e-6) - wheelSpeedFromSlip(kSpeed, slip)) / 1e-6;
    EXPECT_NEAR(prediction.sensitivity_mps, numeric, 1e-5);
  }
}

TEST(SigmaPoints, SensitivityIsContinuousAtZeroSpread) {
  EXPECT_NEAR(SigmaPoints({}).predict(kSpeed, 0.3, 0.0).sensitivity_mps,
              SigmaPoints({}).predict(kSpeed, 0.3, 1e-4).sensitivity_mps, 1e-6);
}

TEST(SigmaPoints, ClampedShortOfThePole) {
  SigmaPointParameters parameters;
  parameters.max_slip = 0.9;
  const SigmaPoints points(parameters);
  for (const double mean : {-3.0, 0.85, 1.0, 5.0}) {
    const WheelSpeedPrediction prediction = points.predict(kSpeed, mean, 0.5);
    EXPECT_TRUE(std::isfinite(prediction.variance));
    EXPECT_GE(prediction.variance, 0.0);
    EXPECT_GE(prediction.mean_mps, kSpeed * (1.0 - 0.9) - 1e-12);
    EXPECT_LE(prediction.mean_mps, kSpeed / (1.0 - 0.9) + 1e-12);
  }
}

TEST(SigmaPoints, ThePapersPointsAndItsFormToTheLetter) {
  constexpr double kMean = 0.1;
  constexpr double kStddev = 0.1;
  for (const bool letter : {false, true}) {
    SigmaPointParameters parameters;
    parameters.form = letter ? "letter" : "paper";
    const double half_width = letter ? kStddev * kStddev : kStddev;
    const double a = kSpeed / (1.0 - kMean);
    const double b = kSpeed / (1.0 - kMean - half_width);
    const double c = kSpeed / (1.0 - kMean + half_width);
    const double mean = (a + b + c) / 3.0;
    const double spread = ((a - mean) * (a - mean) + (b - mean) * (b - mean) + (c - mean) * (c - mean)) / 3.0;
    const double variance = letter ? spread * spread : spread;
    const WheelSpeedPrediction prediction = SigmaPoints(parameters).predict(kSpeed, kMean, kStddev);
    EXPECT_NEAR(prediction.mean_mps, mean, 1e-14);
    EXPECT_NEAR(prediction.variance, variance, 1e-6 * variance);
  }
}

TEST(SigmaPoints, PointsAreThoseThatThePredictionIsMadeOf) {
  SigmaPointParameters parameters;
  parameters.form = "paper";
  const auto [center, above, below] = SigmaPoints(parameters).points(kSpeed, -0.2, 0.1);
  EXPECT_NEAR(center, kSpeed / 1.2, 1e-14);
  EXPECT_NEAR(above, kSpeed / 1.1, 1e-14);
  EXPECT_NEAR(below, kSpeed / 1.3, 1e-14);
  const auto [mean, right, left] = SigmaPoints({}).points(kSpeed, -0.3, 0.05);
  EXPECT_NEAR(mean, kSpeed * 0.7, 1e-14);
  EXPECT_NEAR(right - left, 2.0 * std::sqrt(3.0) * 0.05 * kSpeed, 1e-14);
}

TEST(SigmaPoints, WrongParametersAreRefused) {
  SigmaPointParameters parameters;
  parameters.spread = 0.5;
  EXPECT_THROW(SigmaPoints{parameters}, std::invalid_argument);
  parameters = {};
  parameters.form = "papre";
  EXPECT_THROW(SigmaPoints{parameters}, std::invalid_argument);
  parameters = {};
  parameters.max_slip = 1.0;
  EXPECT_THROW(SigmaPoints{parameters}, std::invalid_argument);
  EXPECT_THROW(SigmaPoints({}).predict(kSpeed, 0.0, -0.1), std::invalid_argument);
  EXPECT_THROW(SigmaPoints({}).predict(kSpeed, 0.0, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
