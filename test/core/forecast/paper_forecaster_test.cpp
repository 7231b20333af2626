/// The paper's forecast against its equations, written out here a second time with plain matrices.

#include "core/forecast/paper_forecaster.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <optional>
#include <utility>

#include "config/config.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

constexpr Nanoseconds kStart = 1'600'000'000'000'000'000;
constexpr double kWheelSpeed_mps = 0.8;
constexpr double kImuStep_s = 0.02;
const Vector3 kForce_b(0.3, -0.2, -9.8);

using Matrix15 = Eigen::Matrix<double, 15, 15>;

/// Six, for a countdown that is ignored.
constexpr int kUnheededSamples = 60;

/// The paper's fifteen states: the others have variance zero.
FilterSetup fifteenStates() {
  Config config;
  config.vehicle = {0.0, 0.0, 24.0, 0.0, 0.0, 0.5, 0.0, 8.0, 0.0, 0.0};
  config.imu.noise.gyro_scale_std_ppm = 0.0;
  return config.navigation().filter;
}

class PaperForecasterTest : public ::testing::Test {
 protected:
  PaperForecasterTest() {
    params_.schedule = "paper";
    params_.bound = "absolute";
    params_.slip.model = "paper";
    params_.slip.inference = "dense";
    params_.sigma_points.form = "paper";
    P_.diagonal().segment<3>(kAttitude) << 1e-7, 1e-7, 5e-6;
    P_.diagonal().segment<3>(kVelocity).setConstant(1e-4);
    P_.diagonal().segment<3>(kPosition) << 0.01, 0.02, 0.01;
    P_.diagonal().segment<3>(kAccelBias).setConstant(1e-6);
    P_.diagonal().segment<3>(kGyroBias).setConstant(1e-9);
    P_(kAttitude + 2, kPosition) = P_(kPosition, kAttitude + 2) = 1e-4;
  }

  PaperForecaster make() const { return {Planet::byName("earth"), fifteenStates(), params_}; }

  /// East on a road, one wheel sample every 0.1 s.
  Estimate estimate(int sample, double slip) const {
    Estimate e;
    e.nav.stamp = kStart + fromSeconds(0.1 * sample);
    e.nav.position = {degToRad(39.7), degToRad(-79.9), 250.0};
    e.nav.q_b_to_n = q_b_to_n_fromEuler(0.05, -0.08, 0.5 * kPi);
    const double speed_mps = wheel_speed_mps_ * (1.0 - slip);
    e.nav.v_eb_n = e.nav.q_b_to_n * Vector3(speed_mps, 0.0, 0.0);
    e.f_ib_b = kForce_b;
    e.has_wheels = true;
    e.wheels.stamp = e.nav.stamp;
    e.wheels.motion.forward_mps = wheel_speed_mps_;
    e.motion = {0.1, Vector3(speed_mps, 0.0, 0.0), Vector3::Zero()};
    return e;
  }

  static double slipAt(int sample) { return 0.05 + 0.03 * std::sin(0.9 * sample) * std::cos(0.31 * sample); }

  std::optional<Forecast> drive(PaperForecaster& forecaster, int samples) {
    std::optional<Forecast> last;
    for (int i = 0; i < samples; ++i, ++sample_) {
      if (std::optional<Forecast> forecast = forecaster.push(estimate(sample_, slipAt(sample_)), P_)) {
        last = std::move(forecast);
        made_.push_back(sample_);
      }
    }
    return last;
  }

  void stand(PaperForecaster& forecaster, int samples) {
    for (int i = 0; i < samples; ++i, ++sample_) {
      Estimate e = estimate(sample_, 0.0);
      e.stationary = true;
      EXPECT_FALSE(forecaster.push(e, P_));
    }
  }

  ForecastParams params_;
  ErrorCovariance P_ = ErrorCovariance::Zero();
  double wheel_speed_mps_ = kWheelSpeed_mps;
  int sample_ = 1;
  std::vector<int> made_;
};

/// F of an inertial navigation system on a non-rotating plane: of the omitted terms, the Earth's rotation is the
/// largest, 7e-5 of the remaining ones.
Matrix15 transitionByHand(const Matrix3& C, const Vector3& force_n) {
  Matrix15 F = Matrix15::Zero();
  F.block<3, 3>(0, 12) = -C;
  F.block<3, 3>(3, 0) << 0, force_n.z(), -force_n.y(), -force_n.z(), 0, force_n.x(), force_n.y(), -force_n.x(), 0;
  F.block<3, 3>(3, 9) = -C;
  F.block<3, 3>(6, 3).setIdentity();
  return Matrix15::Identity() + kImuStep_s * F;
}

Matrix15 noiseByHand(const ImuNoiseParams& imu) {
  const double degree = std::acos(-1.0) / 180.0;
  Eigen::Matrix<double, 15, 1> Q = Eigen::Matrix<double, 15, 1>::Zero();
  Q.segment<3>(0).setConstant(std::pow(imu.gyro_noise_deg_per_sqrt_h * degree / 60.0, 2));
  Q.segment<3>(3).setConstant(std::pow(imu.accel_noise_mps_per_sqrt_h / 60.0, 2));
  Q.segment<3>(9).setConstant(std::pow(imu.accel_bias_walk_ug_per_sqrt_h * 9.80665e-6 / 60.0, 2));
  Q.segment<3>(12).setConstant(std::pow(imu.gyro_bias_walk_deg_per_h_per_sqrt_h * degree / 3600.0 / 60.0, 2));
  return (kImuStep_s * Q).asDiagonal();
}

/// Forward speed, heading rate, lateral and vertical speed.
Eigen::Matrix<double, 4, 15> odometryByHand(const Matrix3& C, const Vector3& v_n) {
  Matrix3 v_cross;
  v_cross << 0, -v_n.z(), v_n.y(), v_n.z(), 0, -v_n.x(), -v_n.y(), v_n.x(), 0;
  const Matrix3 by_attitude = C.transpose() * v_cross;
  const Matrix3 by_velocity = C.transpose();
  Eigen::Matrix<double, 4, 15> H = Eigen::Matrix<double, 4, 15>::Zero();
  H.row(0).segment<3>(0) = by_attitude.row(0);
  H.row(0).segment<3>(3) = by_velocity.row(0);
  H(1, 14) = -1.0;
  H.row(2).segment<3>(0) = by_attitude.row(1);
  H.row(2).segment<3>(3) = by_velocity.row(1);
  H.row(3).segment<3>(0) = by_attitude.row(2);
  H.row(3).segment<3>(3) = by_velocity.row(2);
  return H;
}

/// Mean squared spread of v/(1 − μ), v/(1 − μ ± σ); as printed σ² for σ, and squared.
double wheelVarianceByHand(double v, double mean, double stddev, bool letter) {
  const double half_width = letter ? stddev * stddev : stddev;
  const double a = v / (1.0 - mean);
  const double b = v / (1.0 - mean - half_width);
  const double c = v / (1.0 - mean + half_width);
  const double middle = (a + b + c) / 3.0;
  const double sigma = ((a - middle) * (a - middle) + (b - middle) * (b - middle) + (c - middle) * (c - middle)) / 3.0;
  return letter ? sigma * sigma : sigma;
}

/// 3 √(P_NN + P_EE) after each update.
std::vector<double> boundByHand(const Estimate& e, const Matrix15& P0, const std::vector<double>& wheel_variances) {
  const Matrix3 C = e.nav.q_b_to_n.toRotationMatrix();
  const Matrix15 Phi = transitionByHand(C, C * e.f_ib_b);
  const Matrix15 Q = noiseByHand(ImuNoiseParams{});
  const Eigen::Matrix<double, 4, 15> H = odometryByHand(C, e.nav.v_eb_n);
  std::vector<double> bound;
  Matrix15 P = P0;
  for (const double variance : wheel_variances) {
    for (int i = 0; i < 5; ++i) {
      P = Phi * P * Phi.transpose() + Q;
    }
    const Eigen::Vector4d R(variance, variance, variance, 1.0);
    const Eigen::Matrix4d S = H * P * H.transpose() + Eigen::Matrix4d(R.asDiagonal());
    const Eigen::Matrix<double, 15, 4> K = P * H.transpose() * S.inverse();
    P = (Matrix15::Identity() - K * H) * P;
    P = 0.5 * (P + P.transpose()).eval();
    bound.push_back(3.0 * std::sqrt(P(6, 6) + P(7, 7)));
  }
  return bound;
}

TEST_F(PaperForecasterTest, BoundIsThatOfThePapersEquations) {
  for (const bool letter : {true, false}) {
    params_.sigma_points.form = letter ? "letter" : "paper";
    sample_ = 1;
    PaperForecaster forecaster = make();
    const std::optional<Forecast> forecast = drive(forecaster, 150);
    ASSERT_TRUE(forecast);
    double speed_sum_mps = 0.0;
    for (int i = 1; i <= 150; ++i) {
      speed_sum_mps += kWheelSpeed_mps * (1.0 - slipAt(i));
    }
    const double v = speed_sum_mps / 150.0;
    std::vector<double> variances;
    for (int i = 0; i < 600; ++i) {
      variances.push_back(wheelVarianceByHand(v, forecast->slip.mean(i), forecast->slip.stddev(i), letter));
    }
    const std::vector<double> expected = boundByHand(estimate(150, slipAt(150)), P_.topLeftCorner<15, 15>(), variances);
    const std::vector<double>& bound_m = forecast->error.horizontal_bound_m;
    ASSERT_EQ(bound_m.size(), 600U);
    for (const std::size_t i : {0U, 9U, 99U, 299U, 599U}) {
      EXPECT_NEAR(bound_m[i] / expected[i], 1.0, 2e-3) << "update " << i << ", letter: " << letter;
    }
    EXPECT_GT(bound_m.back(), 1.05 * bound_m.front()) << "else the horizon says nothing";
  }
}

TEST_F(PaperForecasterTest, SlipIsPredictedByAGaussianProcessOfTheWindowAhead) {
  PaperForecaster forecaster = make();
  const std::optional<Forecast> forecast = drive(forecaster, 150);
  ASSERT_TRUE(forecast);
  SlipSamples window;
  for (int i = 1; i <= 150; ++i) {
    window.times_s.push_back(0.1 * i);
    window.slips.push_back(slipAt(i));
  }
  GaussianProcessSlipModel model(params_.slip);
  model.fit(window);
  const SlipPrediction expected = model.predict(Eigen::VectorXd::LinSpaced(600, 15.1, 75.0));
  EXPECT_LT((forecast->slip.mean - expected.mean).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((forecast->slip.stddev - expected.stddev).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_DOUBLE_EQ(forecast->slip.times_s(0), 0.1);
  EXPECT_DOUBLE_EQ(forecast->slip.times_s(599), 60.0);
}

TEST_F(PaperForecasterTest, StopIsDueWhenTheBoundFirstExceedsTheThreshold) {
  PaperForecaster first = make();
  const std::vector<double> bound_m = drive(first, 150).value().error.horizontal_bound_m;
  params_.threshold_m = 0.5 * (bound_m[199] + bound_m[200]);
  ASSERT_LT(bound_m[199], bound_m[200]);
  sample_ = 1;
  PaperForecaster second = make();
  const ErrorOutlook error = drive(second, 150).value().error;
  EXPECT_NEAR(error.time_to_stop_s, 20.1, 1e-9);
  EXPECT_EQ(error.kept_s, error.time_to_stop_s);
  EXPECT_NEAR(error.stop_distance_m, 20.1 * 0.76, 0.02 * 20.1);
}

TEST_F(PaperForecasterTest, ForecastThatSeesNoStopIsFollowedByAnother) {
  params_.threshold_m = 1000.0;
  PaperForecaster forecaster = make();
  const ErrorOutlook error = drive(forecaster, 460).value().error;
  EXPECT_EQ(made_, (std::vector<int>{150, 300, 450}));
  EXPECT_TRUE(std::isinf(error.time_to_stop_s));
  EXPECT_EQ(error.kept_s, 0.0);
}

TEST_F(PaperForecasterTest, CountdownIsKeptUntilTheStopAndTheNextWindowFollowsIt) {
  params_.threshold_m = 0.01;  // immediately: the countdown expires after 0.1 s
  PaperForecaster forecaster = make();
  drive(forecaster, 170);
  EXPECT_EQ(made_, std::vector<int>{150});
  stand(forecaster, 30);
  drive(forecaster, 155);
  EXPECT_EQ(made_, (std::vector<int>{150, 350}));
}

TEST_F(PaperForecasterTest, CountdownThatNobodyHeedsEndsAndAnotherWindowBegins) {
  params_.threshold_m = 0.01;
  PaperForecaster forecaster = make();
  drive(forecaster, 400);
  EXPECT_EQ(made_, (std::vector<int>{150, 150 + 1 + kUnheededSamples + 149}));
}

TEST_F(PaperForecasterTest, StopInsideTheWindowBeginsItAnew) {
  PaperForecaster forecaster = make();
  drive(forecaster, 140);
  stand(forecaster, 1);
  drive(forecaster, 149);
  EXPECT_TRUE(made_.empty());
  drive(forecaster, 1);
  EXPECT_EQ(made_, std::vector<int>{291});
}

TEST_F(PaperForecasterTest, WindowIsFullAfterTwelveMetersOnAFasterRover) {
  wheel_speed_mps_ = 2.0;
  PaperForecaster forecaster = make();
  drive(forecaster, 100);
  ASSERT_EQ(made_.size(), 1U);
  EXPECT_NEAR(made_.front(), 10.0 * 12.0 / (2.0 * 0.95), 2.0);
}

TEST_F(PaperForecasterTest, WheelsThatSpinOnTheSpotAreLeftOut) {
  PaperForecaster forecaster = make();
  drive(forecaster, 100);
  for (int i = 0; i < 20; ++i, ++sample_) {
    forecaster.push(estimate(sample_, 1.0), P_);
  }
  const std::optional<Forecast> forecast = drive(forecaster, 30);
  ASSERT_TRUE(forecast);
  EXPECT_EQ(forecast->fit.samples, 130);
}

TEST_F(PaperForecasterTest, WhatCannotBeForecastIsSaid) {
  P_(kPosition, kPosition) = 1e308;
  P_(kPosition + 1, kPosition + 1) = 1e308;
  PaperForecaster forecaster = make();
  EXPECT_FALSE(drive(forecaster, 160));
  EXPECT_EQ(forecaster.problem(), "the forecast is not finite");
  P_(kPosition, kPosition) = std::nan("");
  drive(forecaster, 1);
  EXPECT_EQ(forecaster.problem(), "the estimate is not finite");
}

TEST_F(PaperForecasterTest, ClockThatGoesBackBeginsAnew) {
  PaperForecaster forecaster = make();
  drive(forecaster, 140);
  sample_ = 1;
  drive(forecaster, 149);
  EXPECT_TRUE(made_.empty());
}

}  // namespace
}  // namespace slipnav
